"""PyPI urx reads joints from `conik emulate`, over the secondary and the real-time port.

    pip install urx
    conik emulate --series cb3 & python tests/clients/urx_joints.py 127.0.0.1
"""
import sys

import urx

for use_rt in (False, True):
    robot = urx.Robot(sys.argv[1], use_rt=use_rt)
    q = robot.getj()
    assert len(q) == 6 and any(abs(angle) > 0.1 for angle in q), q
    if use_rt:
        rt = robot.rtmon.getActual(wait=True)
        assert all(abs(a - b) < 1e-3 for a, b in zip(q, rt)), (q, rt)
    assert robot.is_running()
    robot.close()
    print("urx", "with" if use_rt else "without", "real-time port:", [round(a, 3) for a in q], "ok")
