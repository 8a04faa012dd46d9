#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""serve.py PROGRAM: what `PROGRAM serve` gives and refuses, over sockets of Python's own library."""

import base64
import json
import os
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

SCENE = """<Node name="root" gravity="0 0 0" dt="0.01">
  <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.02" contactDistance="0.01"/>
  <DefaultContactManager/>
  <EulerImplicitSolver/> <CGLinearSolver iterations="50" tolerance="1e-12" threshold="1e-20"/>
  <Node name="body">
    <MeshTopology position="0 0 0  1 0 0  0 1 0" triangles="0 1 2"/>
    <MechanicalObject template="Vec3d"/>
    <UniformMass name="mass" totalMass="3"/>
    <TriangleCollisionModel/>
  </Node>
</Node>
"""

passed = 0


def check(condition, what):
    global passed
    if not condition:
        raise SystemExit(f"serve.py: failed: {what}")
    passed += 1


def connect(port):
    s = socket.create_connection(("127.0.0.1", port), timeout=20)
    s.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return s


def request(port, path, method="GET", host=None, more="", content=b""):
    """Status, headers and content of an answer."""
    with connect(port) as s:
        host = host or f"127.0.0.1:{port}"
        if content:
            more += f"Content-Length: {len(content)}\r\n"
        s.sendall(f"{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n".encode() + content)
        answer = b""
        while part := s.recv(65536):
            answer += part
    head, _, content = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]), head.decode().lower(), content


class Refused(Exception):
    pass


class Ended(Exception):
    pass


class Client:
    """A WebSocket; texts come as objects, other messages as bytes."""

    def __init__(self, port, word, origin="", small=False):
        self.socket = socket.socket()
        if small:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.settimeout(20)
        self.socket.connect(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.bytes = b""
        key = base64.b64encode(os.urandom(16)).decode()
        origin = f"Origin: {origin}\r\n" if origin else ""
        self.socket.sendall(
            f"GET /{word}/stage HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
            f"{origin}Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
        )
        while b"\r\n\r\n" not in self.bytes:
            self.more()
        head, _, self.bytes = self.bytes.partition(b"\r\n\r\n")
        status = int(head.split()[1])
        if status != 101:
            raise Refused(status)

    def more(self):
        try:
            part = self.socket.recv(65536)
        except ConnectionError:
            part = b""
        if not part:
            raise Ended
        self.bytes += part

    def take(self, count):
        while len(self.bytes) < count:
            self.more()
        taken, self.bytes = self.bytes[:count], self.bytes[count:]
        return taken

    def send(self, payload, opcode=1, masked=True):
        if isinstance(payload, dict):
            payload = json.dumps(payload)
        if isinstance(payload, str):
            payload = payload.encode()
        mask = os.urandom(4) if masked else b""
        n = len(payload)
        flag = 0x80 if masked else 0
        if n < 126:
            length = bytes([flag | n])
        elif n < 65536:
            length = bytes([flag | 126]) + struct.pack(">H", n)
        else:
            length = bytes([flag | 127]) + struct.pack(">Q", n)
        if masked:
            payload = bytes(b ^ mask[i % 4] for i, b in enumerate(payload))
        self.socket.sendall(bytes([0x80 | opcode]) + length + mask + payload)

    def message(self):
        first, second = self.take(2)
        opcode, n = first & 15, second & 127
        if n == 126:
            (n,) = struct.unpack(">H", self.take(2))
        elif n == 127:
            (n,) = struct.unpack(">Q", self.take(8))
        content = self.take(n)
        if opcode == 8:
            raise Ended
        if opcode == 9:
            self.send(content, 10)
            return self.message()
        if opcode == 1:
            return json.loads(content)
        if content[0] == 2:
            self.last = content  # frame
        return content

    def until(self, condition, seconds=20):
        """The first message for which the condition holds."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            message = self.message()
            if condition(message):
                return message
        raise SystemExit("serve.py: failed: a message has not come")

    def said(self, what, condition=lambda message: True):
        return self.until(lambda m: isinstance(m, dict) and m["is"] == what and condition(m))

    def frame(self, condition=lambda step: True):
        return self.until(
            lambda m: isinstance(m, bytes) and m[0] == 2 and condition(struct.unpack_from("<d", m, 24)[0])
        )

    def ends(self):
        """Whether the other side closes it."""
        try:
            while True:
                self.message()
        except Ended:
            return True
        except TimeoutError:
            return False

    def close(self):
        self.socket.close()


class Server:
    def __init__(self, program, scene, page, *options):
        self.process = subprocess.Popen(
            [program, "serve", scene, "--port", "0", "--page", page, *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=dict(os.environ, TMPDIR=os.path.join(os.path.dirname(scene), "tmp")),
        )
        self.link = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", self.link)
        check(found, f"the link is printed, not '{self.link}'")
        self.port, self.word = int(found[1]), found[2]

    def client(self, **options):
        return Client(self.port, self.word, **options)

    def works(self):
        """Whether somebody who comes now is shown the scene."""
        client = self.client()
        client.said("scene")
        client.frame()
        client.close()
        return self.process.poll() is None

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        status = self.process.wait(timeout=20)
        check(status == 0, f"Ctrl-C ends it, with status 0, not {status}: {self.process.stderr.read()}")


def files(server, page):
    port, word = server.port, server.word
    status, head, content = request(port, f"/{word}/")
    check(status == 200 and content == b"<p>page</p>", "the page is served behind the word")
    check("content-security-policy: default-src 'self'" in head, "the page may load nothing else")
    check("text/html" in head and "nosniff" in head, "what a file is is said")
    check(request(port, f"/{word}")[0] == 301, "a folder without its slash leads on")
    status, head, content = request(port, f"/{word}/engine.json?1")
    check(status == 200 and json.loads(content) == {"engine": "socket", "opens": True}, "the page learns what runs the scene")
    status, head, content = request(port, f"/{word}/", "HEAD")
    check(status == 200 and content == b"" and "content-length: 11" in head, "HEAD gives no content")
    for path in ["/", "/index.html", "/0123456789abcdef0123456789abcdef/", f"/{word}0/", f"/{word[:-1]}/", "//"]:
        check(request(port, path)[0] == 403, f"{path} is refused")
    for path in [f"/{word}/secret", f"/{word}/../secret.txt", f"/{word}/%2e%2e/secret.txt", f"/{word}//etc/passwd"]:
        status, _, content = request(port, path)
        check(status == 404 and b"kept" not in content, f"{path} is not there")
    check(request(port, f"/{word}/", "POST")[0] == 405, "nothing can be posted")
    check(request(port, f"/{word}/", host="example.com")[0] == 403, "it is called by its own name only")
    check(request(port, f"/{word}/", host=f"localhost:{port}")[0] == 200, "localhost is a name of it")


def refusals(server):
    for word, origin, status in [
        (server.word, "http://example.com", 403),
        (server.word, "null", 403),
        (server.word, f"http://127.0.0.1:{server.port + 1}", 403),
        ("0" * 32, f"http://127.0.0.1:{server.port}", 403),
        ("", "", 403),
    ]:
        try:
            Client(server.port, word, origin)
            check(False, f"a socket for '{origin}' and '{word}' is refused")
        except Refused as refused:
            check(refused.args[0] == status, f"a socket for '{origin}' and '{word}' is refused by {status}")
    client = server.client(origin=f"http://127.0.0.1:{server.port}")
    client.said("scene")
    client.close()


def scene(server):
    client = server.client()
    told = client.said("scene")
    check(told["title"] == "scene.scn" and told["dt"] == 0.01, "the scene is named")
    names = [line.get("class") or line["name"] for line in told["tree"]]
    check(names[0] == "root" and "body" in names and "UniformMass<Vec3d>" in names, f"its tree is told: {names}")
    topology = client.until(lambda m: isinstance(m, bytes))
    kind, number = struct.unpack_from("<II", topology)
    check(kind == 1, "a topology comes before the first frame")
    path = topology[92:102]
    check(path == b"/root/body", f"it has the body: {path}")
    frame = client.frame()
    check(struct.unpack_from("<III", frame) == (2, number, 3), "the frame is of this topology")
    check(struct.unpack_from("<9f", frame, 32) == (0, 0, 0, 1, 0, 0, 0, 1, 0), "and has its points")
    state = client.said("state")
    check(state["step"] == 0 and not state["playing"] and state["error"] == "", "the scene stands at first")

    # two see the same
    other = server.client()
    client.send({"do": "step"})
    client.send({"do": "step"})
    for each in (client, other):
        check(each.said("state", lambda m: m["step"] == 2)["time"] == 0.02, "a step is seen by all")
    # a component and its fields
    line = names.index("UniformMass<Vec3d>")
    client.send({"do": "component", "line": line})
    fields = {f["name"]: f for f in client.said("component")["fields"]}
    check(fields["totalMass"]["value"] == "3", "fields have their values")
    client.send({"do": "setField", "line": line, "field": "totalMass", "value": "-1"})
    check("totalMass" in client.said("error")["text"], "a value out of its range is refused")
    client.send({"do": "setField", "line": line, "field": "totalMass", "value": "6"})
    client.said("state", lambda m: m["undo"] == "totalMass")
    client.send({"do": "undo"})
    client.said("state", lambda m: m["redo"] == "totalMass" and m["undo"] is None)

    # what is held by one who goes falls
    client.send({"do": "press", "origin": [0.3, 0.3, 1], "direction": [0, 0, -1], "stiffness": 200})
    held = other.said("state", lambda m: m["held"])["held"]
    check(held["path"] == "/root/body" and abs(held["point"][0] - 0.3) < 1e-6, f"a press takes hold: {held}")
    client.send({"do": "move", "origin": [0.5, 0.3, 1], "direction": [0, 0, -1]})
    client.send({"do": "step"})
    force = other.said("state", lambda m: m["step"] == 3)["held"]["force"]
    check(force[0] > 1 and abs(force[1]) < 1e-6, f"and pulls: {force}")
    moved = struct.unpack_from("<9f", other.last, 32)
    check(moved[0] > 1e-4, "so that the body moves")
    client.close()
    other.said("state", lambda m: m["held"] is None)
    other.send({"do": "reset"})
    other.said("state", lambda m: m["step"] == 0)
    other.close()


def bundle(**files):
    files = {name.replace("__", "/").replace("_", "."): content.encode() for name, content in files.items()}
    names = [{"name": name, "bytes": len(content)} for name, content in files.items()]
    return json.dumps({"files": names}).encode() + b"\n" + b"".join(files.values())


def opening(server, folder):
    """Scenes that are dropped onto the page."""

    def drop(content, word=None, origin=None, **options):
        origin = f"http://127.0.0.1:{server.port}" if origin is None else origin
        more = f"Origin: {origin}\r\n" if origin else ""
        status, _, answer = request(
            server.port, f"/{word or server.word}/scene", "POST", more=more, content=content, **options
        )
        return status, answer.decode()

    ball = """<Node name="ball" gravity="0 0 -9.81" dt="0.02"><EulerExplicitSolver/>
  <MechanicalObject template="Vec3d" position="1 2 3"/><UniformMass totalMass="1"/>%s</Node>"""
    good = bundle(ball_scn=ball % "")
    one, other = server.client(), server.client()
    for each in (one, other):
        each.said("scene")
    one.send({"do": "play", "on": False})
    one.send({"do": "reset"})
    one.said("state", lambda m: m["step"] == 0 and not m["playing"])
    # not from elsewhere, nor by who does not know the word
    for options, status in [
        ({"origin": ""}, 405),
        ({"origin": "http://example.com"}, 405),
        ({"word": "0" * 32}, 403),
        ({"host": "example.com"}, 403),
    ]:
        check(drop(good, **options)[0] == status, f"a scene with {options} is refused")

    # what is wrong is said, and changes nothing
    def refused(status, words, **files):
        got, answer = drop(bundle(**files))
        check(got == status and words in answer, f"{files} is refused by {status}, {words}: {got}, {answer}")
        check("sinew-scene" not in answer, f"nobody learns where the files were: {answer}")

    for content in [b"x", b"{}\n", bundle(_etc_scn="")[:-3]]:
        check(drop(content)[0] == 400, f"{content} is no files")
    refused(400, "does not lead to a file below a folder", **{"..__a_scn": ball % ""})
    refused(422, "no scene among the files", a_obj="v 0 0 0")
    refused(422, "a.scn:1:", a_scn="<Node")
    refused(422, "a.scn:2:", a_scn="<Node>\n<EulerSolverr/></Node>")
    refused(422, "there is no file 'data/organ.obj'; drop it along with the scene", a_scn='<Node><MeshOBJLoader filename="data/organ.obj"/></Node>')
    # no other files of this machine
    for name in ["/etc/passwd", "../scene.scn", "data/../../scene.scn", "@../a.name"]:
        for element in [f'<MeshOBJLoader name="a" filename="{name}"/>', f'<include href="{name}"/>']:
            refused(422, "finds its files beside itself", a_scn=f"<Node>{element}</Node>")
    refused(422, "finds its files", a_scn='<Node><include href="b.txt"/></Node>', b_txt='<Node><include href="/etc/x"/></Node>')
    written = os.path.join(folder, "written.state")
    refused(422, "finds its files", a_scn=ball % f'<WriteState filename="{written}"/>')
    refused(422, "writes none", a_scn=ball % '<WriteState filename="written.state"/>')
    check(not os.path.exists(written) and not os.path.exists("written.state"), "a scene writes no files")
    status, _, _ = request(
        server.port,
        f"/{server.word}/scene",
        "POST",
        more=f"Origin: http://127.0.0.1:{server.port}\r\nContent-Length: 99999999\r\n",
    )
    check(status == 413, f"files that are too large are refused: {status}")
    one.send({"do": "step"})
    one.said("state", lambda m: m["step"] == 1)
    check(not os.listdir(os.path.join(folder, "tmp")), "nothing is left behind")

    # a scene is seen by all, in the place of the first
    one.send({"do": "press", "origin": [0.3, 0.3, 1], "direction": [0, 0, -1], "stiffness": 200})
    other.said("state", lambda m: m["held"])
    check(drop(good) == (200, ""), "a scene is taken")
    for each in (one, other):
        told = each.said("scene")
        check(told["title"] == "ball.scn" and told["dt"] == 0.02, f"it is told: {told}")
        each.until(lambda m: isinstance(m, bytes) and m[0] == 1)
        each.frame()
        check(struct.unpack_from("<3f", each.last, 32) == (1, 2, 3), "it is seen")
        state = each.said("state")
        check(state["step"] == 0 and not state["playing"] and state["held"] is None, "it stands at first")
    one.send({"do": "step"})
    other.said("state", lambda m: m["step"] == 1 and m["time"] == 0.02)
    # with files of its own
    scene = '<Node><MeshOBJLoader name="l" filename="data/o.obj"/><VisualModel src="@l"/></Node>'
    for _ in range(100):  # until that before has gone
        status, answer = drop(bundle(a__b_scn=scene, a__data__o_obj="mtllib /etc/hosts\nusemtl m\nv 0 0 7\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))
        if status != 503:
            break
        time.sleep(0.05)
    check(status == 200, f"its files come with it: {status} {answer}")
    check("/etc/hosts: this file is elsewhere" in answer, f"materials of other files are not read: {answer}")
    told = one.said("scene")
    check(told["title"] == "b.scn", "a scene of a folder is named")
    one.until(lambda m: isinstance(m, bytes) and m[0] == 1)
    one.frame()
    check(struct.unpack_from("<3f", one.last, 32) == (0, 0, 7), "and its mesh is seen")
    # which may have been dropped beside it
    for _ in range(100):
        status, answer = drop(bundle(b_scn=scene, o_obj="v 0 0 7\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))
        if status != 503:
            break
        time.sleep(0.05)
    check(status == 200, f"a file beside the scene is found: {status} {answer}")
    for _ in range(100):  # until those of the scene before have gone
        left = os.listdir(os.path.join(folder, "tmp"))
        if len(left) == 1:
            break
        time.sleep(0.05)
    check(len(left) == 1, f"its files are there as long as it is: {left}")
    for each in (one, other):
        each.close()


def garbage(server):
    client = server.client()
    state = client.said("state")
    for command, answer in [
        ("", "no JSON"),
        ("hello", "no JSON"),
        ('{"do": "step"', "no JSON"),
        ("[1, 2]", "no object"),
        ('{"do": "fly"}', "nothing is called 'fly'"),
        ('{"do": "speed", "times": -1}', "must be from"),
        ('{"do": "step", "more": 1}', "has no member 'more'"),
        ("[" * 10000, "nested too deep"),
    ]:
        client.send(command)
        check(answer in client.said("error")["text"], f"'{command[:40]}' is refused: {answer}")
    client.send(b"\x01\x02\x03", opcode=2)
    check("no text" in client.said("error")["text"], "a command is text")
    client.send({"do": "component", "line": 12345})
    check("line 12345" in client.said("error")["text"], "there is no such component")
    other = server.client()
    check(other.said("state") == state, "nothing of this has changed the scene")
    other.close()
    client.close()

    client = server.client()
    client.send(" " * 20000)
    check(client.ends(), "who sends too much at a time is left")
    client = server.client()
    client.send("\xff\xfe".encode("latin-1"))
    check(client.ends(), "who sends text that is none is left")
    client = server.client()
    client.send({"do": "step"}, masked=False)
    check(client.ends(), "who does not keep to the protocol is left")
    check(server.works(), "it goes on after that")

    randomly = random.Random(7)
    for _ in range(150):
        with connect(server.port) as s:
            s.sendall(randomly.randbytes(randomly.randrange(1, 400)))
    for _ in range(150):
        client = server.client()
        try:
            client.socket.sendall(randomly.randbytes(randomly.randrange(1, 400)))
        except ConnectionError:
            pass
        client.close()
    with connect(server.port) as s:
        try:
            s.sendall(b"GET / HTTP/1.1\r\n" + b"A: " + b"a" * 100000 + b"\r\n\r\n")
            s.recv(10)
        except ConnectionError:
            pass
    check(server.works(), "random bytes do not harm it")


def many(server, limit):
    clients = []
    for _ in range(limit):
        clients.append(server.client())
        clients[-1].said("scene")
    try:
        server.client()
        check(False, "there are not too many")
    except Refused as refused:
        check(refused.args[0] == 503, "one too many is told so")
    clients[0].send({"do": "step"})
    for client in clients:
        client.said("state", lambda m: m["step"] == 1)
    for client in clients:
        client.close()
    for _ in range(100):  # until it has noticed
        try:
            client = server.client()
            break
        except Refused:
            time.sleep(0.05)
    client.said("scene")
    client.send({"do": "reset"})
    client.said("state", lambda m: m["step"] == 0)
    client.close()


def slow(server):
    """Who reads late sees what is now, and not all that was."""
    late, prompt = server.client(small=True), server.client()
    late.said("scene")
    prompt.send({"do": "speed", "times": 0})
    prompt.send({"do": "play", "on": True})
    end = time.monotonic() + 6
    frames = 0
    while time.monotonic() < end:
        frames += isinstance(prompt.message(), bytes)
    check(frames > 50, f"one who reads sees frames while another does not read: {frames}")
    prompt.send({"do": "play", "on": False})
    last = prompt.said("state", lambda m: not m["playing"])["step"]
    check(last > 1000, f"and the scene goes on: {last}")
    late.frame(lambda step: step == last)
    for client in (late, prompt):
        client.close()


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        page, path = os.path.join(folder, "page"), os.path.join(folder, "scene.scn")
        os.mkdir(page)
        os.mkdir(os.path.join(folder, "tmp"))
        for name, content in [
            (path, SCENE),
            (os.path.join(page, "index.html"), "<p>page</p>"),
            (os.path.join(page, "secret"), "kept"),
            (os.path.join(folder, "secret.txt"), "kept"),
        ]:
            with open(name, "w") as file:
                file.write(content)
        server = Server(program, path, page, "--clients", "4")
        try:
            files(server, page)
            refusals(server)
            scene(server)
            garbage(server)
            many(server, 4)
            slow(server)
            taken = subprocess.run(
                [program, "serve", path, "--port", str(server.port), "--page", page], capture_output=True, text=True
            )
            check(
                taken.returncode == 4 and f"port {server.port} is in use" in taken.stderr and "--port" in taken.stderr,
                f"a port in use is said: {taken.stderr}",
            )
            watching = server.client()
            watching.said("scene")
            watching.send({"do": "play", "on": True})
            watching.said("state", lambda m: m["playing"])
            opening(server, folder)
            server.interrupt()
            check(not os.listdir(os.path.join(folder, "tmp")), "no file of a scene is left behind")
            check(watching.ends(), "who looks learns that it has ended")
        finally:
            server.process.kill()
        none = subprocess.run([program, "serve", path, "--page", folder], capture_output=True, text=True)
        check(none.returncode == 4 and "no page" in none.stderr, f"a missing page is said: {none.stderr}")
        nowhere = subprocess.run(
            [program, "serve", path, "--page", page, "--address", "nowhere"], capture_output=True, text=True
        )
        check(nowhere.returncode == 4 and "is no address" in nowhere.stderr, f"an address is one: {nowhere.stderr}")
    print(f"{passed} checks passed")


if __name__ == "__main__":
    main()
