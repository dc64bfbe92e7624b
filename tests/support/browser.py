"""Drives a headless Chromium through its DevTools protocol over a pipe, with the standard library alone."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


class Browser:
    def __init__(self):
        self.profile = tempfile.mkdtemp()
        ours_in, theirs_out = os.pipe()
        theirs_in, ours_out = os.pipe()

        def place():
            os.dup2(theirs_in, 203), os.dup2(theirs_out, 204)
            os.dup2(203, 3), os.dup2(204, 4)

        flags = ["--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--enable-unsafe-swiftshader",
                 "--user-data-dir=" + self.profile, "--hide-scrollbars", "--window-size=1400,900",
                 "--no-first-run", "--disable-background-networking", "about:blank"]
        self.process = subprocess.Popen(["chromium"] + flags, preexec_fn=place, close_fds=False,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in), os.close(theirs_out)
        self.reader, self.writer = ours_in, ours_out
        self.number, self.rest, self.events = 0, b"", []

    def read(self, seconds):
        """The next message, or None."""
        end = time.monotonic() + seconds
        while b"\0" not in self.rest:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.reader], [], [], left)[0]:
                return None
            got = os.read(self.reader, 1 << 16)
            if not got:
                raise RuntimeError("the browser has ended")
            self.rest += got
        line, self.rest = self.rest.split(b"\0", 1)
        return json.loads(line)

    def call(self, method, session=None, **params):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if session:
            message["sessionId"] = session
        os.write(self.writer, json.dumps(message).encode() + b"\0")
        while True:
            reply = self.read(60)
            if reply is None:
                raise RuntimeError(method + ": no answer")
            if reply.get("id") == self.number:
                if "error" in reply:
                    raise RuntimeError(method + ": " + reply["error"]["message"])
                return reply["result"]
            self.events.append(reply)

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.reader), os.close(self.writer)
        shutil.rmtree(self.profile, ignore_errors=True)


class Page:
    def __init__(self, browser, url):
        self.browser = browser
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log"]:
            self.call(domain + ".enable")
        self.go(url)

    def call(self, method, **params):
        return self.browser.call(method, self.session, **params)

    def go(self, url):
        self.call("Page.navigate", url=url)

    def js(self, expression):
        reply = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in reply:
            raise RuntimeError(expression + ": " + json.dumps(reply["exceptionDetails"])[:600])
        return reply["result"].get("value")

    def wait(self, expression, seconds=20):
        """Until it is true; its value, or None."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.js(expression)
            if value:
                return value
            time.sleep(0.03)
        return None

    def mouse(self, kind, x, y, button="left"):
        pressed = 0 if kind == "mouseReleased" else 1
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=pressed, clickCount=1)

    def key(self, key):
        for kind in ["keyDown", "keyUp"]:
            self.call("Input.dispatchKeyEvent", type=kind, key=key, text=key if len(key) == 1 and kind == "keyDown" else "")

    def shot(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def complaints(self):
        """What came to the console as an error or warning, and what was thrown."""
        self.js("1")
        found, rest = [], []
        for event in self.browser.events:
            params, method = event.get("params", {}), event.get("method")
            if event.get("sessionId") != self.session:
                rest.append(event)
            elif method == "Runtime.exceptionThrown":
                details = params["exceptionDetails"]
                found.append(details["text"] + " " + details.get("exception", {}).get("description", ""))
            elif method == "Runtime.consoleAPICalled" and params["type"] in ["error", "warning", "assert"]:
                found.append(" ".join(str(a.get("value", a.get("description"))) for a in params["args"]))
            elif method == "Log.entryAdded" and params["entry"]["level"] in ["error", "warning"]:
                found.append(params["entry"]["text"] + " " + params["entry"].get("url", ""))
        self.browser.events = rest
        return [one for one in found if "GL Driver Message" not in one and "GPU stall" not in one]
