"""A Modbus device whose registers are those of a file, read at each request.

    server.py PORT FILE     FILE: {"input": [305], "holding": [16889, 39322]}, words from register 0
"""
import asyncio
import json
import pathlib
import sys

from pymodbus.server import StartAsyncTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice


async def main():
    port, file = int(sys.argv[1]), pathlib.Path(sys.argv[2])

    async def look(function, start, _address, _count, registers, _values):
        """Function 4 reads input registers, 3 holding registers."""
        words = json.loads(file.read_text())["input" if function == 4 else "holding"]
        registers[-start:len(words) - start] = words

    words = [SimData(0, count=10, values=0, datatype=DataType.REGISTERS)]
    bits = [SimData(0, values=False, datatype=DataType.BITS)]
    device = SimDevice(1, simdata=(bits, bits, words, words), action=look)
    print("ready", flush=True)
    await StartAsyncTcpServer(device, address=("127.0.0.1", port))


asyncio.run(main())
