"""PyPI pyfocas 0.1.1 reads the mock of `trueaxis live mock fanuc`. Run by scripts/live-pyfocas PORT."""

import sys

from pyfocas.protocol.protocol import FOCAS

client = FOCAS("127.0.0.1", int(sys.argv[1]))
assert client.connect(), "no connection"
system = client.get_sys_info()
print(system)
assert (system.cnc_type, system.mt_type, system.series, system.axes) == ("31", "M", "G42A", "03")
status = client.get_status_info()
print(status)
client.write_macro_double(510, 197.62)
macro = client.read_macro(510)
print(macro)
assert abs(macro[510] - 197.62) < 1e-6
print("pyfocas 0.1.1: connect, sysinfo, statinfo, macro written and read")
