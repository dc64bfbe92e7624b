"""Films the program for README.md and the documents: screens.py REX FOLDER

Writes dragged.webp (the mouse drags a hand in `rex view`), failed.webp (the replay that a student gets who draws the circle
of exercise 01 in the wrong plane) and check.png (the picture of that check).
"""

import math
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests" / "support"))
from browser import Browser, Page  # noqa: E402

EXERCISE = "01-kinematics"
RIGHT, WRONG = "std::cos(angle), 0, std::sin(angle)", "std::cos(angle), std::sin(angle), 0"
FIRST, LAST, RATE = 0.6, 7.5, 8  # seconds of the replay, pictures per second

solution = (root / "exercises" / EXERCISE / "solution.cpp").read_text()
if solution.count(RIGHT) != 1:
    sys.exit("screens.py: the solution of %s has changed" % EXERCISE)


def page_of(browser, url, width, height, ready):
    page = Page(browser, "about:blank")
    page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
    page.go(url)
    if not page.wait(ready, 200):
        sys.exit("screens.py: %s does not get ready" % url)
    return page


class Film:
    def __init__(self, page):
        self.page, self.folder, self.count = page, tempfile.TemporaryDirectory(), 0

    def take(self):
        self.page.js("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")
        self.page.shot(pathlib.Path(self.folder.name) / ("%03d.png" % self.count))
        self.count += 1

    def write(self, file, width, quality=80):
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", str(RATE), "-i", self.folder.name + "/%03d.png", "-vf",
                        "scale=%d:-2:flags=lanczos" % width, "-c:v", "libwebp_anim", "-loop", "0", "-quality", str(quality),
                        "-compression_level", "6", file], check=True)
        self.folder.cleanup()


def failed_check(browser, rex, folder, out):
    (folder / "main.cpp").write_text(solution.replace(RIGHT, WRONG))
    test = subprocess.run([rex, "test", "01", "--check", "circle", "--main", folder / "main.cpp", "-o", folder], cwd=root)
    if test.returncode != 1:
        sys.exit("screens.py: the check does not fail")
    shutil.copy(folder / "checks" / "circle.png", out / "check.png")
    film = Film(page_of(browser, f"file://{folder}/checks/circle.html#paused", 960, 556,
                        "document.body && document.body.classList.contains('running')"))
    for k in range(round((LAST - FIRST) * RATE)):
        film.page.js("(() => { const t = document.getElementById('time'); t.value = %r; t.dispatchEvent(new Event('input')); })()"
                     % (FIRST + k / RATE))
        film.take()
    film.write(out / "failed.webp", 960)


def dragged(browser, rex, out):
    process = subprocess.Popen([rex, "view", "man", "--no-browser"], cwd=root, stdout=subprocess.PIPE, text=True)
    try:
        film = Film(page_of(browser, process.stdout.readline().strip(), 960, 640, "window.rexLive && rexLive.frames() > 0"))
        page = film.page
        page.js("document.querySelector('[data-mode=drag]').click()")
        x, y = page.js("rexLive.pixel(rexLive.position(rexLive.about().bodies.findIndex(body => body.name === 'handR')))")
        page.mouse("mouseMoved", x, y)
        page.mouse("mousePressed", x, y)
        for k in range(48):
            angle = 2 * math.pi * k / 47
            page.mouse("mouseMoved", x - 70 * (1 - math.cos(angle)), y - 70 * math.sin(angle))
            page.wait("rexLive.frame().drag && Math.hypot(...rexLive.frame().drag.at.map((v, i) => v - rexLive.frame().drag.to[i])) < .02", 1)
            film.take()
        page.mouse("mouseReleased", x, y)
        film.write(out / "dragged.webp", 640, 60)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)


if __name__ == "__main__":
    rex, out = sys.argv[1], pathlib.Path(sys.argv[2])
    chromium = Browser()
    dragged(chromium, rex, out)
    with tempfile.TemporaryDirectory() as name:
        failed_check(chromium, rex, pathlib.Path(name), out)
    chromium.close()
