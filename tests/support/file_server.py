#!/usr/bin/env python3
"""Serves a folder over HTTP on the loopback interface for tests of downloads.

file_server.py FOLDER PORT_FILE [BREAK_AFTER]
Writes the port that it got into PORT_FILE. Unlike python3 -m http.server it can send a file from the
middle on (Range), as the servers of data sets do. With BREAK_AFTER it breaks the connection after so
many bytes of every answer. Each request is a line on stdout: "GET PATH FROM".
"""
import http.server
import os
import re
import sys


class Handler(http.server.BaseHTTPRequestHandler):
    folder = ""
    break_after = None

    def do_GET(self):
        path = os.path.join(self.folder, self.path.lstrip("/"))
        asked = re.fullmatch(r"bytes=(\d+)-", self.headers.get("Range", ""))
        start = int(asked.group(1)) if asked else 0
        print("GET", self.path, start, flush=True)
        if not os.path.isfile(path):
            self.send_error(404)
            return
        with open(path, "rb") as file:
            content = file.read()
        if asked and start >= len(content):
            self.send_error(416)
            return
        self.send_response(206 if asked else 200)
        self.send_header("Content-Length", str(len(content) - start))
        if asked:
            self.send_header("Content-Range", f"bytes {start}-{len(content) - 1}/{len(content)}")
        self.end_headers()
        end = len(content) if self.break_after is None else start + self.break_after
        self.wfile.write(content[start:end])

    def log_message(self, *_):
        pass


def main():
    Handler.folder = sys.argv[1]
    if len(sys.argv) > 3:
        Handler.break_after = int(sys.argv[3])
    server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
    with open(sys.argv[2] + ".new", "w") as file:
        file.write(str(server.server_port))
    os.rename(sys.argv[2] + ".new", sys.argv[2])
    server.serve_forever()


main()
