"""Runs `trueaxis live` with sensors that server.py measures, breaks them, and checks what the run says.

    main.py TRUEAXIS FOLDER
"""
import json
import os
import pathlib
import shutil
import signal
import socket
import struct
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).parent
SOUND = 305
# Scale of X: a signed word, tenths of a degree; of Y: a number of two registers; workpiece: 16 bits from -40 °C in hundredths.
SOURCES = {
    "scale_x": 'table = "input", register = 0, as = "i16", scale = 0.1',
    "scale_y": 'table = "holding", register = 0, as = "f32"',
    "workpiece": 'table = "holding", register = 2, as = "u16", scale = 0.01, offset = -40',
}
DUE_C = {"scale_x": 30.5, "scale_y": 31.2, "workpiece": 30.5}


class Device:
    def __init__(self, folder):
        self.file = folder / "registers.json"
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.log = open(folder / "server.log", "w")
        self.set()
        self.start()

    def set(self, tenths=SOUND):
        high, low = struct.unpack(">HH", struct.pack(">f", 31.2))
        text = json.dumps({"input": [tenths & 0xffff], "holding": [high, low, 7050]})
        part = self.file.with_suffix(".part")
        part.write_text(text)
        part.replace(self.file)

    def start(self):
        command = [sys.executable, str(HERE / "server.py"), str(self.port), str(self.file)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.log, text=True)
        if not self.process.stdout.readline():
            sys.exit(f"the device did not start: {self.log.name}")

    def end(self):
        self.process.kill()
        self.process.wait()


def plan(folder, port, change=lambda text: text):
    text = (ROOT / "examples/08_live/gantry-mock.toml").read_text()
    text = text.replace("../../machines", str(ROOT / "machines"))
    log = 'source = { log = "../03_predict/torque-arm-hall.csv", start = "200 min", speed = 10 }'
    for source in SOURCES.values():
        text = text.replace(log, f'source = {{ modbus = "127.0.0.1:{port}", unit = 1, {source}, period = "200 ms" }}', 1)
    text = text.replace('stale = "90 s"', 'stale = "2 s"') + '\n[journal]\nfolder = "journal"\n'
    file = folder / "live.toml"
    file.write_text(change(text))
    return file


def main():
    trueaxis, folder = sys.argv[1], pathlib.Path(sys.argv[2]) / "runs"
    shutil.rmtree(folder, ignore_errors=True)
    failed = []

    def check(what, good, more=""):
        print(f"{'ok    ' if good else 'FAILED'} {what} {more}", flush=True)
        if not good:
            failed.append(what)

    def case(name, seconds, act, change=lambda text: text):
        """What a run of some seconds says while something happens to its device, and its last state."""
        own = folder / name
        own.mkdir(parents=True)
        device = Device(own)
        file = plan(own, device.port, change)
        run = subprocess.Popen([trueaxis, "live", str(file), "--for", f"{seconds}s"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        act(device, file)
        text, _ = run.communicate(timeout=90)
        device.end()
        return text, run.returncode

    states = {}

    def sound(_, file):
        time.sleep(5)
        status = subprocess.run([trueaxis, "live", "status", str(file), "--format", "json"], capture_output=True, text=True)
        states.update({s["sensor"]: s["celsius"] for s in json.loads(status.stdout)["last"]["sensors"]})

    text, code = case("sound", 7, sound)
    right = all(states.get(name) is not None and abs(states[name] - due) < 0.011 for name, due in DUE_C.items())
    check("a signed word, a number of two words and a word with an offset are read", right and code == 0, str(states) if right else text)

    def then(seconds, *acts):
        def act(device, _):
            for each in acts:
                time.sleep(seconds)
                each(device)
        return act

    def held(text, words):
        hold, back = text.find("Hold: "), text.rfind("Run: follows its target")
        return words in text and 0 <= hold < back

    text, _ = case("open", 14, then(4, lambda d: d.set(32767), lambda d: d.set()))
    check("a sensor that is open (32767, 3276.7 °C): holds, goes on when it is sound", held(text, "outside its range"), "" if held(text, "outside its range") else text)
    text, _ = case("below", 14, then(4, lambda d: d.set(-400), lambda d: d.set()))
    check("below zero (-40.0 °C by two's complement): holds, goes on", held(text, "-40 °C"), "" if held(text, "-40 °C") else text)
    text, _ = case("killed", 20, then(4, lambda d: d.end(), lambda d: d.start()))
    check("the device ends and starts again: holds, goes on", held(text, "older than 2 s"), "" if held(text, "older than 2 s") else text)
    stop, go = (lambda d: d.process.send_signal(signal.SIGSTOP)), (lambda d: d.process.send_signal(signal.SIGCONT))
    text, _ = case("frozen", 20, then(4, stop, go))
    check("the device is frozen for 4 s: holds, goes on", held(text, "older than 2 s"), "" if held(text, "older than 2 s") else text)
    far = lambda text: text.replace('register = 0, as = "i16"', 'register = 60000, as = "i16"')
    text, _ = case("refused", 6, lambda *_: None, far)
    check("a register that the device does not have is named by its reason", "Run:" not in text and "scale_x" in text, text.strip().splitlines()[-1] if text.strip() else "")

    os.sync()
    print(f"{len(failed)} checks failed" if failed else "all checks passed")
    sys.exit(1 if failed else 0)


main()
