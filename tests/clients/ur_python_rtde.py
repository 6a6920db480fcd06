"""The maker's own Python RTDE client against `conik emulate`, in both versions of the protocol.

    git clone https://github.com/UniversalRobots/RTDE_Python_Client_Library
    conik emulate & python tests/clients/ur_python_rtde.py 127.0.0.1 RTDE_Python_Client_Library
"""
import sys
import time

host, checkout = sys.argv[1:3]
sys.path.insert(0, checkout)
import rtde.rtde as rtde  # noqa: E402

connection = rtde.RTDE(host, 30004)
connection.connect()
version = connection.get_controller_version()
rate = 125 if version[0] == 3 else 500
print("controller", version)
names = ["timestamp", "actual_q", "input_double_register_30", "input_int_register_30"]
types = ["DOUBLE", "VECTOR6D", "DOUBLE", "INT32"]
assert connection.send_output_setup(names, types, frequency=rate)
inputs = connection.send_input_setup(
    ["input_double_register_30", "input_int_register_30"], ["DOUBLE", "INT32"]
)
assert inputs
assert connection.send_start()
first = last = None
for count in range(5 * rate):
    state = connection.receive()
    assert state is not None, "connection lost"
    first = first or state.timestamp
    last = state.timestamp
    inputs.input_double_register_30 = count / 7
    inputs.input_int_register_30 = count
    connection.send(inputs)
time.sleep(0.1)
for _ in range(100):
    state = connection.receive()
assert state.input_int_register_30 == count, state.input_int_register_30
assert state.input_double_register_30 == count / 7
cycles = round((last - first) * rate) + 1
print(count + 1, "packages over", cycles, "cycles, registers read back: ok")
assert connection.send_pause()
connection.disconnect()
