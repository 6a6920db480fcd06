"""The maker's C++ client library against `conik emulate`: its own example programs.

    git clone https://github.com/UniversalRobots/Universal_Robots_Client_Library CHECKOUT
    cmake -S CHECKOUT -B BUILD && cmake --build BUILD
    conik emulate & python tests/clients/ur_cpp.py 127.0.0.1 CHECKOUT BUILD
"""
import re
import subprocess
import sys
from pathlib import Path

host, checkout, build = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])


def example(name, *arguments, says):
    """Runs an example to its end; it must say all of this, and complain of nothing until then.

    While they end, threads of the library may still write to a socket that is closed already.
    """
    program = next((path for path in [build / "examples" / name, build / name] if path.exists()), None)
    assert program, f"there is no {name} in {build}"
    # The examples read their recipes and the robot's program from where they stand.
    ended = subprocess.run(
        [program.resolve(), host, *arguments],
        cwd=checkout,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        timeout=60,
    )
    output = ended.stdout
    assert ended.returncode == 0, f"{name} ended with {ended.returncode}:\n{output}"
    for part in says:
        assert part in output, f"{name} does not say '{part}':\n{output}"
    before = output[: output.index(says[-1])]
    bad = re.search(r"^.*\b(ERROR|FATAL)\b.*$", before, re.MULTILINE)
    assert not bad, f"{name} complains: {bad.group()}"
    print(name, "ok", flush=True)


example("rtde_client_example", "3", says=["target_speed_fraction: [", "Exiting RTDE read/write example"])
example("primary_pipeline_example", "2", says=["dh_alpha: [1.5708 0 0 1.5708 -1.5708 0 ]", "Robot type: 1"])
example("dashboard_example", says=["Program state: STOPPED wait_program.urp", "Power off command success: 1"])
# Turns wrist 3 to +2 rad and back with servoj, each reference an answer to a package.
example("driver_example", says=["Robot control program is running", "Movement done"])
