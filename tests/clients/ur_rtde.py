"""PyPI ur-rtde against `conik emulate`: Receive, IO, Dashboard, and Control with servoJ.

    pip install ur-rtde
    conik emulate & python tests/clients/ur_rtde.py 127.0.0.1
"""
import sys
import time

import dashboard_client
import rtde_control
import rtde_io
import rtde_receive

host = sys.argv[1]

dashboard = dashboard_client.DashboardClient(host)
dashboard.connect()
assert dashboard.robotmode() == "Robotmode: RUNNING", dashboard.robotmode()
assert "NORMAL" in dashboard.safetystatus()
assert not dashboard.running()
version = dashboard.polyscopeVersion()
rate = 125.0 if version.removeprefix("URSoftware ").startswith("3.") else 500.0
print("Dashboard:", version, "ok")

receive = rtde_receive.RTDEReceiveInterface(host)
q0 = receive.getActualQ()
assert len(q0) == 6 and receive.getRobotMode() == 7 and receive.getSafetyMode() == 1
before = receive.getTimestamp()
time.sleep(0.2)
assert receive.getTimestamp() > before
print("Receive: q =", [round(q, 3) for q in q0], "ok")

for upper in (True, False):
    flags = rtde_control.RTDEControlInterface.FLAG_UPLOAD_SCRIPT
    if upper:
        flags |= rtde_control.RTDEControlInterface.FLAG_UPPER_RANGE_REGISTERS
    control = rtde_control.RTDEControlInterface(host, rate, flags)
    assert control.isProgramRunning() and dashboard.running()
    q = receive.getActualQ()
    start = q[5]
    for _ in range(int(rate)):
        period = control.initPeriod()
        q[5] += 0.5 / rate
        assert control.servoJ(q, 0.5, 0.5, 1 / rate, 0.1, 300)
        control.waitPeriod(period)
    time.sleep(1.0)
    moved = receive.getActualQ()[5] - start
    assert abs(moved - 0.5) < 1e-3, moved
    assert control.servoStop()
    control.stopScript()
    time.sleep(0.2)
    assert not dashboard.running()
    control.disconnect()
    print("Control:", "upper" if upper else "lower", "registers: wrist 3 moved by", round(moved, 4), "rad ok")

io = rtde_io.RTDEIOInterface(host)
assert io.setSpeedSlider(0.5)
assert io.setStandardDigitalOut(3, True)
time.sleep(0.2)
assert abs(receive.getTargetSpeedFraction() - 0.5) < 1e-9, receive.getTargetSpeedFraction()
assert receive.getDigitalOutState(3)
assert io.setSpeedSlider(1.0)
print("IO: speed slider and digital output ok")
