"""Films the replay that a student gets who draws the circle of exercise 01 in the wrong plane, and takes the picture of that check.

failed_check.py REX FOLDER writes failed.webp and check.png.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests" / "support"))
from browser import Browser, Page  # noqa: E402

RIGHT, WRONG = "std::cos(angle), 0, std::sin(angle)", "std::cos(angle), std::sin(angle), 0"
FIRST, LAST, RATE = 0.6, 7.5, 8  # seconds of the replay, pictures per second

rex, out = sys.argv[1:]
solution = (root / "exercises" / "01-kinematics" / "solution.cpp").read_text()
if solution.count(RIGHT) != 1:
    sys.exit("failed_check.py: the solution of 01-kinematics has changed")
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "main.cpp").write_text(solution.replace(RIGHT, WRONG))
    test = subprocess.run([rex, "test", "01", "--check", "circle", "--main", folder / "main.cpp", "-o", folder], cwd=root)
    if test.returncode != 1:
        sys.exit("failed_check.py: the check does not fail")
    shutil.copy(folder / "checks" / "circle.png", pathlib.Path(out) / "check.png")
    browser = Browser()
    page = Page(browser, "about:blank")
    page.call("Emulation.setDeviceMetricsOverride", width=960, height=556, deviceScaleFactor=1, mobile=False)
    page.go(f"file://{folder}/checks/circle.html#paused")
    if not page.wait("document.body && document.body.classList.contains('running')", 60):
        sys.exit("failed_check.py: the replay does not play")
    for k in range(round((LAST - FIRST) * RATE)):
        page.js("(() => { const t = document.getElementById('time'); t.value = %r; t.dispatchEvent(new Event('input')); })()"
                % (FIRST + k / RATE))
        page.js("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")
        page.shot(folder / ("%03d.png" % k))
    browser.close()
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", str(RATE), "-i", folder / "%03d.png", "-c:v", "libwebp_anim",
                    "-loop", "0", "-quality", "80", "-compression_level", "6", pathlib.Path(out) / "failed.webp"], check=True)
