"""The faults that were found by hand: losses, wrong beliefs, time and memory, the server. Each gives what was seen and whether
it survived."""

import http.client
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

from . import kinds

ALL = []


def fault(name):
    def keep(work):
        ALL.append((name, work))
        return work

    return keep


class Ran:
    def __init__(self, shop, words, wait_s=120):
        begun = time.monotonic()
        child = subprocess.Popen(["prlimit", "--as=4294967296", shop.program, *words], cwd=shop.place, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            self.out, err = child.communicate(timeout=wait_s)
            self.status, self.err = child.returncode, err.decode(errors="replace")
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            self.status, self.out, self.err = "no end", b"", ""
        self.took_s = time.monotonic() - begun

    def says(self, *words):
        text = self.err + self.out.decode(errors="replace")
        return all(word in text for word in words)


class Shop:
    """A folder of its own with the examples."""

    def __init__(self, program, base, place):
        self.program, self.place = program, place
        shutil.copytree(base, place)

    def run(self, command, *more, **options):
        return Ran(self, [*kinds.words(command), *more], **options)

    def path(self, name):
        return self.place / kinds.long(name)

    def text(self, name):
        return self.path(name).read_text(encoding="utf-8")

    def write(self, name, text):
        path = self.path(name)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return name


POST = f"post {kinds.I5} 06/bangle.cls --control fanuc"
OVER = [
    (f"{POST} -o 06/bangle.cls --force", "06/bangle.cls"),
    (f"{POST} -o d/hard.cls --force", "06/bangle.cls"),
    (f"{POST} -o d/link.cls --force", "06/bangle.cls"),
    (f"{POST} -o {kinds.I5}", kinds.I5),
    ("compensate adapt made/adapt.toml --cl made/adapt.toml", "made/adapt.toml"),
    ("identify 05/probe-ball.toml -o 05/probe-ball.toml", "05/probe-ball.toml"),
    (f"identify rtcp 05/rtcp-engraver.toml -o {kinds.I5}", kinds.I5),
    (f"identify rtcp 05/rtcp-engraver.toml -o {kinds.XKAS}", kinds.XKAS),
    ("evaluate iso230-2 07/x-axis-laser.csv --report 07/x-axis-laser.csv", "07/x-axis-laser.csv"),
]


@fault("1, 2: outputs over inputs, through links, and over another machine's file")
def over_inputs(shop):
    (shop.place / "d").mkdir()
    os.link(shop.path("06/bangle.cls"), shop.place / "d/hard.cls")
    os.symlink(shop.path("06/bangle.cls"), shop.place / "d/link.cls")
    refused = 0
    for command, kept in OVER:
        before = shop.path(kept).read_bytes()
        ran = shop.run(command)
        refused += ran.status == 2 and ran.says("unwritable-file") and shop.path(kept).read_bytes() == before
    return f"{refused} of {len(OVER)} refused, every file as before", refused == len(OVER)


@fault("1: a plan again over its table that was filled in")
def filled_in(shop):
    words = "plan probe-surface made/probe-surface.toml --control fanuc -o d"
    first = shop.run(words).status
    table = shop.place / "d/surface.csv"
    again = shop.run(words).status
    filled = table.read_text().replace("\n", ",1.5\n")
    table.write_text(filled)
    third = shop.run(words)
    kept = table.read_text() == filled
    return f"first {first}, again {again}, filled in {third.status}; the readings {'stay' if kept else 'are lost'}", (first, again, third.status, kept) == (0, 0, 2, True)


@fault("2: own output edited by a person")
def edited(shop):
    (shop.place / "d").mkdir()
    words = f"{POST} -o d/b.nc"
    done = [shop.run(words).status, shop.run(words).status]
    program = shop.place / "d/b.nc"
    text = program.read_text() + "(mine)\n"
    program.write_text(text)
    done.append(shop.run(words).status)
    kept = program.read_text() == text
    done.append(shop.run(words, "--force").status)
    return f"exit status first, again, edited, --force: {done}", kept and done == [0, 0, 2, 0]


@fault("3: reports unasked")
def reports(shop):
    before = sorted(p for p in shop.place.rglob("*"))
    commands = ("predict 03/cone-on-i5.toml", f"simulate {kinds.I5} 02/ring-fanuc.nc", "compensate adapt made/adapt.toml")
    for command in commands:
        shop.run(command), shop.run(command, "--format", "json")
    new = [str(p.relative_to(shop.place)) for p in shop.place.rglob("*") if p not in before]
    return f"{2 * len(commands)} runs, files written: {new or 'none'}", not new


@fault("3: runs killed while they write")
def killed(shop):
    (shop.place / "k").mkdir()
    whole = set()
    command = [shop.program, *kinds.words(f"simulate {kinds.I5} 02/ring-fanuc.nc --path k/path.csv --force")]
    for i in range(30):
        child = subprocess.Popen(command, cwd=shop.place, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.004 * i)
        child.send_signal(signal.SIGKILL if i % 2 else signal.SIGTERM)
        child.wait()
        path = shop.place / "k/path.csv"
        if path.exists():
            whole.add(path.read_bytes()[-200:])
    left = len(list((shop.place / "k").glob(".trueaxis-*.part")))
    last = shop.run(f"simulate {kinds.I5} 02/ring-fanuc.nc --path k/path.csv --force")
    whole.add((shop.place / "k/path.csv").read_bytes()[-200:])
    halves = len(list((shop.place / "k").glob(".trueaxis-*.part")))
    return f"30 runs killed, {left} parts left, {halves} after the next run; the file was whole whenever it was there", last.status in (0, 1) and halves == 0 and len(whole) == 1


@fault("4: a heading in µm that says mm")
def headings(shop):
    refused, tried = 0, 0
    text = shop.text("made/probe-ball.csv")
    for axis in "xyz":
        shop.write("made/probe-ball.csv", text.replace(f"{axis}_um", f"{axis}_mm", 1))
        ran = shop.run("identify made/probe-ball.toml")
        tried, refused = tried + 1, refused + (ran.status == 2 and ran.says("impossible-value", "probe-ball.csv"))
    shop.write("made/probe-ball.csv", text)
    laser = shop.text("07/x-axis-laser.csv")
    shop.write("07/x-axis-laser.csv", laser.replace("deviation_um", "deviation_mm"))
    warned = shop.run("evaluate iso230-2 07/x-axis-laser.csv").says("deviation_mm", "[plausible]")
    shop.write("07/x-axis-laser.csv", laser)
    return f"{refused} of {tried} refused with the row; a laser that could read it: {'warned of' if warned else 'silent'}", refused == tried and warned


@fault("4: an error table of 100 mm")
def table_of_100_mm(shop):
    text = shop.text("machines/xkas2525/X.csv")
    rows = text.splitlines()
    cells = rows[-2].split(",")
    cells[1] = "100000"
    rows[-2] = ",".join(cells)
    shop.write("machines/xkas2525/X.csv", "\n".join(rows) + "\n")
    ran = shop.run(f"check {kinds.XKAS}")
    shop.write("machines/xkas2525/X.csv", text)
    return f"exit status {ran.status}, {re.findall('.[a-z]+-value.', ran.err)[:1]}", ran.status == 2 and ran.says("impossible-value", f"X.csv:{len(rows) - 1}")


@fault("5: every reading four times")
def repeated(shop):
    text = shop.text("made/probe-ball.csv")
    head, *rows = text.splitlines()
    once = json.loads(shop.run("identify made/probe-ball.toml --format json").out)["errors"]
    shop.write("made/probe-ball.csv", "\n".join([head, *rows * 4]) + "\n")
    ran = json.loads(shop.run("identify made/probe-ball.toml --format json").out)
    shop.write("made/probe-ball.csv", text)
    named = {d["line"] for d in ran["diagnostics"] if d["code"] == "copied-rows"}
    same = ran["errors"] == once
    return f"{len(named)} rows named, values and U {'as without them' if same else 'differ'}", same and len(named) > 0


HUGE = [
    ("05/y-axis-two-temperatures.csv", "identify expansion 05/y-axis-two-temperatures.toml", "cold_um"),
    ("07/body-diagonals.csv", "evaluate iso230-6 07/body-diagonals.csv", "deviation_um"),
    ("07/certificate-program-after.csv", "verify --certificate 07/certificate-program.toml", "z_um"),
    ("made/probe-ball.csv", "identify made/probe-ball.toml", "x_um"),
]


@fault("6: one reading of 1e9 or 1e308")
def huge_readings(shop):
    refused, tried = 0, 0
    for file, command, heading in HUGE:
        text = shop.text(file)
        rows = text.splitlines()
        at, column = len(rows) - 1, next(r for r in rows if not r.startswith("#")).split(",").index(heading)
        for value in ("1e9", "1e308"):
            cells = rows[at].split(",")
            cells[column] = value
            shop.write(file, "\n".join([*rows[:at], ",".join(cells), *rows[at + 1 :]]) + "\n")
            ran = shop.run(command, "--format", "json")
            here = [d for d in json.loads(ran.out)["diagnostics"] if d["severity"] == "error" and d["line"] == at + 1]
            tried, refused = tried + 1, refused + (ran.status == 2 and bool(here))
        shop.write(file, text)
    return f"{refused} of {tried} refused with the row", refused == tried


@fault("7: tool lengths of 160 m in set-up, machine file and argument")
def long_tools(shop):
    ring = f"simulate {kinds.I5} 02/ring-fanuc.nc"
    setup, machine = shop.text("02/ring-fanuc.setup.toml"), shop.text(kinds.I5)
    shop.write("made/long.setup.toml", setup.replace('"90 mm"', '"160 m"', 1))
    shop.write("machines/i5-engraver/long.toml", machine + '\n[tool.library.long]\nlength = "160 m"\n')
    ran = [
        shop.run(f"{ring} --setup made/long.setup.toml"),
        shop.run("simulate machines/i5-engraver/long.toml 02/ring-fanuc.nc"),
        shop.run("pose machines/i5-engraver/machine.toml --at X=1 --tool-length 160000"),
    ]
    # Stated on purpose, the collision check still has an end.
    shop.write("made/stated.setup.toml", setup.replace('"90 mm"', '"160 m"', 1) + "\n[plausible]\ntool_length_mm = 200000\n")
    stated = shop.run(f"{ring} --setup made/stated.setup.toml")
    good = all(r.status == 2 and r.says("impossible-value") for r in ran) and stated.status in (0, 1, 2)
    return f"refused in {max(r.took_s for r in ran):.1f} s; stated on purpose: exit status {stated.status} in {stated.took_s:.1f} s", good and stated.took_s < 60


@fault("7: 2 MB and 20 MB of `a` lines as TOML")
def many_lines(shop):
    seen, good = [], True
    for size in (2, 20):
        shop.write("made/a.toml", b"a\n" * (size << 19))
        ran = shop.run("check made/a.toml")
        seen.append(f"{size} MB: exit status {ran.status}, {ran.took_s:.1f} s, {len(ran.err)} bytes of messages")
        good &= ran.status == 2 and ran.took_s < 10 and ran.says("over-limit")
    return "; ".join(seen), good


@fault("7: a column name of 190 MB")
def long_name(shop):
    shop.write("made/wide.csv", b"x" * (190 << 20) + b",X\n1,2\n")
    ran = shop.run(f"pose {kinds.XKAS} --at-file made/wide.csv")
    os.remove(shop.place / "made/wide.csv")
    return f"exit status {ran.status} in {ran.took_s:.1f} s, {len(ran.err)} bytes of messages", ran.status == 2 and len(ran.err) < 10_000 and ran.took_s < 20


@fault("7: pipes and devices as files")
def pipes(shop):
    os.mkfifo(shop.place / "made/pipe.toml")
    endless = shop.run("check /dev/zero")
    child = subprocess.Popen([shop.program, "check", "made/pipe.toml"], cwd=shop.place, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(0.5)
    # A command line may wait for a pipe that its user names, as `cat` does; written to, it ends.
    with open(shop.place / "made/pipe.toml", "w") as pipe:
        pipe.write("x")
    piped = child.wait(20)
    os.remove(shop.place / "made/pipe.toml")
    return f"/dev/zero: exit status {endless.status} in {endless.took_s:.1f} s; a pipe is read to its end: {piped}", endless.status == 2 and piped == 2


class Served:
    """A server on loopback with a client that may be rude."""

    def __init__(self, shop, *more):
        self.child = subprocess.Popen([shop.program, "serve", "served", "--port", "0", *more], cwd=shop.place, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        link = self.child.stdout.readline().decode().strip()
        self.host, _, self.token = link.removeprefix("http://").partition("/?token=")
        self.address = (self.host.rsplit(":", 1)[0], int(self.host.rsplit(":", 1)[1].strip("/")))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.child.kill()
        self.child.wait()

    def ask(self, question="project", token=None, **headers):
        """Status and seconds of a request; 0 where no answer comes within 20 s."""
        begun = time.monotonic()
        sent = {"Content-Type": "application/json", "Authorization": f"Bearer {self.token if token is None else token}", **headers}
        connection = http.client.HTTPConnection(*self.address, timeout=20)
        try:
            connection.request("POST", f"/api/{question}", b"{}", sent)
            status = connection.getresponse().status
        except OSError:
            status = 0
        connection.close()
        return status, time.monotonic() - begun

    def open(self, number, begin=b""):
        found = []
        for _ in range(number):
            one = socket.create_connection(self.address, timeout=5)
            try:
                one.sendall(begin)
            except OSError:
                pass
            found.append(one)
        return found


def served_folder(shop):
    folder = shop.place / "served"
    if not folder.exists():
        shutil.copytree(shop.place / "machines", folder)


@fault("8: 300 slow bodies and 256 silent sockets")
def slow(shop):
    served_folder(shop)
    with Served(shop) as server:
        head = f"POST /api/project HTTP/1.1\r\nHost: {server.host}\r\nAuthorization: Bearer {server.token}\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n{{"
        held = server.open(300, head.encode()) + server.open(256)
        asked = [server.ask() for _ in range(5)]
        for one in held:
            one.close()
        after = server.ask()
    longest = max(t for _, t in asked)
    return f"5 requests meanwhile: {[s for s, _ in asked]}, the longest {longest:.2f} s; after it: {after[0]}", all(s == 200 for s, _ in asked) and longest < 5 and after[0] == 200


@fault("8: a FIFO in the folder that is served")
def fifo(shop):
    served_folder(shop)
    os.mkfifo(shop.place / "served/pipe.toml")
    with Served(shop) as server:
        asked = [server.ask() for _ in range(3)]
    os.remove(shop.place / "served/pipe.toml")
    return f"{[s for s, _ in asked]}, the longest {max(t for _, t in asked):.2f} s", all(s == 200 and t < 5 for s, t in asked)


@fault("9: origins, hosts and tokens")
def origins(shop):
    served_folder(shop)
    with Served(shop, "--origin", "https://mill.example") as server:
        seen = {
            "own": server.ask(Origin=f"http://{server.host}")[0],
            "proxy with TLS": server.ask(Origin="https://mill.example", Host="mill.example")[0],
            "foreign origin": server.ask(Origin="https://evil.example")[0],
            "foreign host": server.ask(Host="evil.example")[0],
            "no token": server.ask(token="")[0],
            "wrong token": server.ask(token="0" * 64)[0],
        }
    return ", ".join(f"{k}: {v}" for k, v in seen.items()), list(seen.values()) == [200, 200, 403, 403, 401, 401]


def all_faults(program, base, place):
    rows = []
    for i, (name, work) in enumerate(ALL):
        shop = Shop(program, base, Path(place) / str(i))
        try:
            seen, held = work(shop)
        except (OSError, ValueError, KeyError, IndexError) as error:
            seen, held = f"{type(error).__name__}: {error}", False
        rows.append((name, seen, held))
        shutil.rmtree(shop.place, ignore_errors=True)
    return rows
