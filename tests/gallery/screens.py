"""Films the program for README.md and the documents: screens.py REX FOLDER

Writes exercises.webp (a picture of each exercise, that of the course's pages) and dragged.webp (the mouse drags a hand in
`rex view`). Of the circle of exercise 01 in the wrong plane: test.webp (`rex test` in a terminal), check.png (the picture of the
check), failed.webp (its replay) and watch.webp (the page of `rex watch`). Of a small class: statistics.webp.
"""

import fcntl
import html
import math
import os
import pathlib
import pty
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import tomllib

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests" / "support"))
from browser import Browser, Page  # noqa: E402

# Where a film says more than the picture of the course's pages.
FILMS = {"00b": "turns.mp4", "01": "circle.mp4", "02": "peg.mp4", "03": "circle.mp4", "04": "path.mp4", "05": "filter.mp4",
         "06": "slam.mp4", "07": "balanced.mp4", "07b": "swings.mp4", "09": "learnt.mp4", "11": "street.mp4", "12": "around.mp4",
         "13": "humanoid.mp4", "14": "deletion.mp4", "15": "adjusting.mp4", "16": "balanced.mp4", "18": "mapping.mp4"}
EXERCISE = "01-kinematics"
RIGHT, WRONG = "std::cos(angle), 0, std::sin(angle)", "std::cos(angle), std::sin(angle), 0"
FIRST, LAST, RATE = 0.6, 7.5, 8  # seconds of the replay, pictures per second

solution = (root / "exercises" / EXERCISE / "solution.cpp").read_text()
if solution.count(RIGHT) != 1:
    sys.exit("screens.py: the solution of %s has changed" % EXERCISE)


def page_of(browser, url, width, height, ready, scale=1):
    page = Page(browser, "about:blank")
    page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)
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


def still(page, file, quality=80):
    with tempfile.NamedTemporaryFile(suffix=".png") as shot:
        page.shot(shot.name)
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", shot.name, "-c:v", "libwebp", "-quality", str(quality), file], check=True)


def draw_page(browser, body, width, file, scale=1):
    """A picture of HTML, as high as it is."""
    with tempfile.NamedTemporaryFile("w", suffix=".html") as text:
        text.write("<!DOCTYPE html><meta charset=utf-8>" + body)
        text.flush()
        page = page_of(browser, "file://" + text.name, width, 100, "document.readyState === 'complete'", scale)
        height = page.js("document.documentElement.scrollHeight")
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)
        still(page, file)


def typed(command, folder, columns=80):
    """The exit code of a command in a terminal, and what it printed, as HTML."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
    process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=subprocess.DEVNULL)
    os.close(theirs)
    text = b""
    try:
        while part := os.read(ours, 65536):
            text += part
    except OSError:  # so Linux says that nobody writes any more
        pass
    os.close(ours)
    text = html.escape(text.decode().replace("\r\n", "\n"))
    return process.wait(), re.sub("\x1b\\[(\\d+)m(.*?)\x1b\\[0m", r'<span class="c\1">\2</span>', text, flags=re.S)


def draw_terminal(browser, command, text, file, after=""):
    draw_page(browser, """<style>body { margin: 0; padding: 12px 16px; background: #1d2229; color: #e4e7eb }
        pre { margin: 0; font: 14px/1.35 "DejaVu Sans Mono", monospace } b { color: #fff } img { width: 100%%; margin-top: 12px }
        .c31 { color: #ff7b72 } .c32 { color: #6cc96f } .c33 { color: #e3b341 } .c2, .c90 { color: #98a2ad }</style>
        <pre><b>$ %s</b>\n%s</pre>%s""" % (command, text.rstrip().replace("scripts/rex", "rex"), after), 720, file, 16 / 9)


def at_last_third(film, picture):
    seconds = float(subprocess.run(["ffprobe", "-v", "error", "-show_entries", "format=duration", "-of", "csv=p=0", film],
                                   check=True, capture_output=True, text=True).stdout)
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-ss", str(seconds * 2 / 3), "-i", film, "-frames:v", "1", picture], check=True)


def draw_exercises(browser, rex, out):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([rex, "dev", "site", folder + "/site"], cwd=root, check=True)
        cells = ""
        for picture in sorted(pathlib.Path(folder, "site/exercises").glob("*.png")):
            number = picture.stem.split("-")[0]
            if film := FILMS.get(number):
                at_last_third(root / "out" / (picture.stem + "-solution") / film, picture)
            title = tomllib.loads((root / "exercises" / picture.stem / "exercise.toml").read_text())["title"]
            cells += "<figure><img src='%s'><figcaption><b>%s</b> %s</figcaption></figure>" % (picture, number, html.escape(title))
        draw_page(browser, """<style>body { margin: 0; padding: 8px; font: 13px/1.25 "DejaVu Sans", sans-serif; background: #e9ecef;
            display: flex; flex-wrap: wrap; justify-content: center; gap: 8px } figure { margin: 0; width: 204px; background: #fff }
            img { width: 204px; height: 153px; object-fit: contain } figcaption { padding: 2px 6px 6px; height: 48px }</style>"""
                  + cells, 1280, out / "exercises.webp")


def written(solved, wrong):
    """main.cpp of a student who has solved some regions of the exercise."""
    def region(found):
        return found[2] if found[1] in solved else re.sub(r"^ *//\| ?", "", found[3], flags=re.M)
    text = re.sub(r"^ *// <solution (\w+)>\n(.*?)^ *// <todo>\n(.*?)^ *// </solution>\n", region, solution, flags=re.M | re.S)
    return text.replace(RIGHT, WRONG) if wrong else text


def draw_statistics(browser, rex, folder, out):
    regions = re.findall(r"<solution (\w+)>", solution)
    chance = random.Random(1)
    for number in range(12):
        file = folder / "class" / ("student%02d" % number) / EXERCISE / "main.cpp"
        file.parent.mkdir(parents=True)
        solved = [one for k, one in enumerate(regions) if chance.random() < 1 - 0.09 * k]
        file.write_text(written(solved, wrong=number % 3 == 0))
    subprocess.run([rex, "grade", folder / "class", "01", "-o", folder / "results"], cwd=root, stdout=subprocess.DEVNULL)
    parts = folder / "parts.png"
    code, text = typed([rex, "dev", "stats", folder / "results", "--parts", parts], root)
    if code != 0:
        sys.exit("screens.py: no statistics: " + text)
    draw_terminal(browser, "rex dev stats results --parts parts.png", text.replace(str(parts), "parts.png"),
                  out / "statistics.webp", "<img src='%s'>" % parts)


def failed_check(browser, rex, folder, out):
    (folder / "main.cpp").write_text(solution.replace(RIGHT, WRONG))
    code, text = typed([rex, "test", "01", "--check", "circle", "--main", folder / "main.cpp", "-o", folder], root)
    if code != 1:
        sys.exit("screens.py: the check does not fail")
    draw_terminal(browser, "rex test 01 --check circle", text.replace(str(folder), "out/" + EXERCISE), out / "test.webp")
    shutil.copy(folder / "checks" / "circle.png", out / "check.png")
    film = Film(page_of(browser, f"file://{folder}/checks/circle.html#paused", 960, 556,
                        "document.body && document.body.classList.contains('running')"))
    for k in range(round((LAST - FIRST) * RATE)):
        film.page.js("(() => { const t = document.getElementById('time'); t.value = %r; t.dispatchEvent(new Event('input')); })()"
                     % (FIRST + k / RATE))
        film.take()
    film.write(out / "failed.webp", 960)


def watched(browser, rex, folder, out):
    """After a save that made the line right; the circle is still wrong. In a course folder, which an installed rex makes."""
    subprocess.run(["cmake", "--install", pathlib.Path(rex).parent, "--prefix", folder / "installed"],
                   stdout=subprocess.DEVNULL, check=True)
    rex, file = folder / "installed" / "bin" / "rex", folder / "course" / "exercises" / EXERCISE / "main.cpp"
    subprocess.run([rex, "init", folder / "course"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
    regions = re.findall(r"<solution (\w+)>", solution)
    file.write_text(written([one for one in regions if one != "straightLine"], wrong=True))
    process = subprocess.Popen([rex, "watch", "01", "--open"], cwd=folder / "course", stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, text=True)
    try:
        url = process.stdout.readline().removeprefix("page: ").strip()
        page = page_of(browser, url, 1280, 800, "document.getElementById('state')?.textContent.startsWith('graded')")
        file.write_text(written(regions, wrong=True))
        if not page.wait("document.querySelector('#news li') && document.querySelector('#evidence img')?.complete", 200):
            sys.exit("screens.py: the page of rex watch shows nothing new")
        page.js("document.querySelector('#evidence').scrollIntoView({ block: 'end' })")
        still(page, out / "watch.webp")
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)


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
    draw_exercises(chromium, rex, out)
    dragged(chromium, rex, out)
    with tempfile.TemporaryDirectory() as name:
        failed_check(chromium, rex, pathlib.Path(name), out)
        watched(chromium, rex, pathlib.Path(name), out)
        draw_statistics(chromium, rex, pathlib.Path(name), out)
    chromium.close()
