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
print("controller", connection.get_controller_version())
names = ["timestamp", "actual_q", "input_double_register_30", "input_int_register_30"]
types = ["DOUBLE", "VECTOR6D", "DOUBLE", "INT32"]
assert connection.send_output_setup(names, types, frequency=500)
inputs = connection.send_input_setup(
    ["input_double_register_30", "input_int_register_30"], ["DOUBLE", "INT32"]
)
assert inputs
assert connection.send_start()
first = last = None
for count in range(2500):
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
assert state.input_int_register_30 == 2499, state.input_int_register_30
assert state.input_double_register_30 == 2499 / 7
cycles = round((last - first) * 500) + 1
print("2500 packages over", cycles, "cycles, registers read back: ok")
assert connection.send_pause()
connection.disconnect()
