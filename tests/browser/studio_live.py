# SPDX-License-Identifier: Apache-2.0
"""The connection on which the page asks for predictions: a client of its own, by RFC 6455."""
import os
import socket
import struct

KEY, ACCEPT = "dGhlIHNhbXBsZSBub25jZQ==", "s3pPLMBiTxaQ9kYGzzhZRbK+xOo="  # the example of RFC 6455, section 1.3
TEXT, BINARY, CLOSING, PING, PONG = 1, 2, 8, 9, 10


class Live:
    def __init__(self, studio, **instead):
        headers = {"Host": studio.host, "Origin": f"http://{studio.host}", "Cookie": studio.cookie, "Upgrade": "websocket",
                   "Connection": "Upgrade", "Sec-WebSocket-Key": KEY, "Sec-WebSocket-Version": "13", **instead}
        self.socket = socket.create_connection(("127.0.0.1", studio.port), timeout=30)
        self.socket.sendall(("GET /api/live HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in headers.items() if value is not None) + "\r\n").encode())
        self.head = b""
        while not self.head.endswith(b"\r\n\r\n"):
            self.head += self.bytes(1)
        self.status = int(self.head.split()[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def bytes(self, count):
        """As many; fewer where the other side ends the connection."""
        got = b""
        while len(got) < count:
            more = self.socket.recv(count - len(got))
            if not more:
                break
            got += more
        return got

    def send(self, kind, payload, masked=True, whole=True):
        mask = os.urandom(4)
        size = bytes([len(payload)]) if len(payload) < 126 else struct.pack(">BH", 126, len(payload)) if len(payload) < 65536 else struct.pack(">BQ", 127, len(payload))
        size = bytes([size[0] | (0x80 if masked else 0)]) + size[1:]
        body = bytes(byte ^ mask[k % 4] for k, byte in enumerate(payload))
        self.socket.sendall(bytes([(0x80 if whole else 0) | kind]) + size + (mask + body if masked else payload))

    def receive(self):
        """(kind, bytes); (None, b"") at the end."""
        head = self.bytes(2)
        if len(head) < 2:
            return None, b""
        assert head[0] & 0xF0 == 0x80 and head[1] < 128, head
        length = head[1]
        if length > 125:
            length, = struct.unpack(">H" if length == 126 else ">Q", self.bytes(2 if length == 126 else 8))
        return head[0] & 0xF, self.bytes(length)
