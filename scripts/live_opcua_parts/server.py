"""A control with an OPC UA server: axes that move, offsets that act, a PLC that watches the heartbeat.

    server.py PORT FOLDER [--at X Y Z] [--deny NODE]

Writes what it saw into FOLDER/seen.json when it ends by SIGTERM: values written, largest step, whether the watchdog has tripped.
"""
import argparse
import asyncio
import datetime
import json
import pathlib
import signal
import time

from asyncua import Server, ua
from asyncua.crypto.cert_gen import setup_self_signed_certificate
from asyncua.server.user_managers import UserManager
from asyncua.crypto.permission_rules import User, UserRole
from cryptography.x509.oid import ExtendedKeyUsageOID

TIMEOUT_S = 1.0
RAMP_MM_PER_S = 0.2
# The temperature is sound for so long.
SENSOR_S = 6.0
TENTHS = {"scale_x": 305, "scale_y": 312}
NUMBERS = {"X": 0.0, "Y": 0.0, "Z": 0.0, "offsetX": 0.0, "offsetY": 0.0, "slopeX": 0.0, "referenceX": 1200.0}
FLAGS = {"referenced": True, "running": True, "inhibit": False, "emergency": False, "tripped": False, "hold": False}


class Users(UserManager):
    """Anonymous without encryption; with it one user."""

    def get_user(self, iserver, username=None, password=None, certificate=None):
        if username is None or (username == "trueaxis" and password == "a secret"):
            return User(role=UserRole.User)
        return None


async def measure(nodes, fault):
    """Tenths of a degree; the time of the source is that of the writing. Only the scale of Y fails."""
    for name, tenths in TENTHS.items():
        of_node = fault if name == "scale_y" else None
        if of_node == "bad":
            await nodes[name].write_value(ua.DataValue(ua.Variant(tenths, ua.VariantType.Int16), ua.StatusCode(ua.StatusCodes.BadSensorFailure),
                                                       SourceTimestamp=datetime.datetime.now(datetime.timezone.utc)))
        elif of_node != "frozen":
            await nodes[name].write_value(tenths, ua.VariantType.Int16)


async def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("port", type=int)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--at", nargs=3, type=float, default=[3500.0, 2300.0, 400.0])
    arguments.add_argument("--deny")
    arguments.add_argument("--sensor", choices=["frozen", "bad"], help="what becomes of the temperature after some seconds")
    options = arguments.parse_args()
    host, uri = "127.0.0.1", "urn:trueaxis:test:control"
    key, certificate = options.folder / "server.pem", options.folder / "server.der"
    await setup_self_signed_certificate(key, certificate, uri, host, [ExtendedKeyUsageOID.SERVER_AUTH], {"commonName": "control"})
    server = Server(user_manager=Users())
    await server.init()
    server.set_endpoint(f"opc.tcp://{host}:{options.port}")
    await server.set_application_uri(uri)
    server.set_security_policy([ua.SecurityPolicyType.NoSecurity, ua.SecurityPolicyType.Basic256Sha256_Sign,
                                ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt])
    await server.load_certificate(str(certificate))
    await server.load_private_key(str(key))
    await server.set_build_info("urn:product", "Maker", "Control", "1.0", "1", datetime.datetime(2026, 1, 1))
    space = await server.register_namespace("urn:trueaxis:test")
    nodes = {}

    async def add(name, value, kind):
        node = await server.nodes.objects.add_variable(ua.NodeId(name, space), name, value, kind)
        if name != options.deny:
            await node.set_writable()
        nodes[name] = node

    for name, value in NUMBERS.items():
        await add(name, value, ua.VariantType.Double)
    for name, value in FLAGS.items():
        await add(name, value, ua.VariantType.Boolean)
    await add("mode", 2, ua.VariantType.Int16)
    await add("beat", 0, ua.VariantType.Byte)
    for name, tenths in TENTHS.items():
        await add(name, tenths, ua.VariantType.Int16)
    seen = dict(offsets=[], largest_step_mm=0.0, beats=0, tripped=0, largest_mm=[0.0, 0.0], slope=0.0)
    ended = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, ended.set)
    async with server:
        print(f"ready {space}", flush=True)
        last, beat, beat_at, before = [0.0, 0.0], 0, None, time.monotonic()
        begun, measured = before, 0.0
        while not ended.is_set():
            await asyncio.sleep(0.01)
            now = time.monotonic()
            dt, before = now - before, now
            if now - measured > 0.5:
                measured = now
                await measure(nodes, options.sensor if now - begun > SENSOR_S else None)
            offsets = [await nodes[f"offset{axis}"].get_value() for axis in "XY"]
            slope, reference = [await nodes[name].get_value() for name in ("slopeX", "referenceX")]
            seen["slope"] = max(seen["slope"], slope, key=abs)
            new = await nodes["beat"].get_value()
            if new != beat:
                beat, beat_at = new, now
                seen["beats"] += 1
            tripped = beat_at is not None and now - beat_at > TIMEOUT_S
            if tripped:
                seen["tripped"] += 1
                step = RAMP_MM_PER_S * dt
                slope = 0.0
                await nodes["slopeX"].write_value(slope)
                offsets = [max(0.0, o - step) if o > 0.0 else min(0.0, o + step) for o in offsets]
                for axis, offset in zip("XY", offsets):
                    await nodes[f"offset{axis}"].write_value(offset)
            await nodes["tripped"].write_value(tripped)
            along = slope * (options.at[0] - reference)
            for i, (axis, offset) in enumerate(zip("XYZ", [offsets[0] + along, offsets[1], 0.0])):
                await nodes[axis].write_value(options.at[i] + offset)
                if i < 2 and offset != last[i]:
                    if not tripped:
                        seen["largest_step_mm"] = max(seen["largest_step_mm"], abs(offset - last[i]))
                    seen["largest_mm"][i] = max(seen["largest_mm"][i], abs(offset))
                    last[i] = offset
            seen["offsets"] = last
    (options.folder / "seen.json").write_text(json.dumps(seen))


asyncio.run(main())
