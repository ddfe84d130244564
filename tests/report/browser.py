"""A page in headless Chromium, as a reader meets it: opened from the disk, without a network, with everything the
console says."""
import base64
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from selected import SLOW, run, slow  # noqa: F401 (for the scripts; it takes --slow from the words)

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian package python3-selenium)")
    sys.exit(77)
for program, package in [("chromium", "chromium"), ("chromedriver", "chromium-driver")]:
    if not shutil.which(program):
        print(f"SKIPPED: no {program} (Debian package {package})")
        sys.exit(77)

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--window-size=1366,900"]


def engine_is_todays(sources):
    """Whether the engine in web/dist was compiled from src/ as it stands: between releases it is older, and its numbers
    are those of the commit that it names."""
    commit = re.search(r"\((\w+)\)", (sources / "web/dist/engine_version.txt").read_text())[1]
    try:
        return subprocess.run(["git", "-C", sources, "diff", "--quiet", commit, "--", "src/*.cpp", "src/*.hpp",
                               "src/*.h",
                               "web/engine"], capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


class Browser:
    """`with Browser() as b: b.open(page)`. Its profile is new and empty, its downloads go to b.downloads."""

    def __enter__(self):
        self.folder = tempfile.mkdtemp()
        self.downloads = pathlib.Path(self.folder, "downloads")
        self.downloads.mkdir()
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in [*FLAGS, f"--user-data-dir={self.folder}/profile"]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
        self.driver.execute_cdp_cmd("Browser.setDownloadBehavior",
                                    {"behavior": "allow", "downloadPath": str(self.downloads)})
        return self

    def __exit__(self, *_):
        self.driver.quit()
        shutil.rmtree(self.folder, ignore_errors=True)

    def wait(self, condition, what, seconds=40):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := condition():
                return value
            time.sleep(0.05)
        raise AssertionError(f"{what}: not within {seconds} s; console: {self.console()}")

    def open(self, page):
        self.driver.get_log("browser"), self.driver.get_log("performance")
        self.driver.get(page.resolve().as_uri())
        self.wait(lambda: self.js("return document.documentElement.dataset.ready === 'true'"), "the page is ready")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def console(self):
        """What the console has said since the page was opened, or since the last time."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """Addresses asked for since the page was opened."""
        events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0])?.innerText ?? null", selector)

    def trace(self, plot, k=0):
        """What a figure has drawn: its cells (with their borders and middles) or its curves, in order."""
        return self.js(
            """const t = document.getElementById(arguments[0]).drawn.data[arguments[1]];
               return {x: [...t.x], y: [...t.y], z: t.z && t.z.map(r => [...r]), at: t.at, name: t.name}""", plot, k)

    def place(self, plot, x, y):
        """Where a point of a figure's axes is in the window, after the figure has been brought there."""
        return self.js(
            """const host = document.getElementById(arguments[0]);
               host.scrollIntoView({block: 'center', behavior: 'instant'});
               const p = host.drawn.plane, box = host.getBoundingClientRect();
               return [box.left + p.left + p.width * (arguments[1] - p.x[0]) / (p.x[1] - p.x[0]),
                       box.top + p.top + p.height * (p.y[1] - arguments[2]) / (p.y[1] - p.y[0])];""", plot, x, y)

    def mouse(self, kind, place, **more):
        self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": f"mouse{kind}", "x": place[0], "y": place[1],
                                                                 **more})

    def drag(self, start, end, **more):
        button = {"button": "left", "clickCount": 1, **more}
        self.mouse("Moved", start, **more)
        self.mouse("Pressed", start, **button)
        for share in (0.3, 0.7, 1):
            self.mouse("Moved", [a + share * (b - a) for a, b in zip(start, end)], **button)
        self.mouse("Released", end, **button)

    def double_click(self, place):
        for count in (1, 2):
            for kind in ("Pressed", "Released"):
                self.mouse(kind, place, button="left", clickCount=count)

    def words(self, plot):
        """The words beside the pointer, None without."""
        return self.js("const words = document.querySelector('#' + arguments[0] + ' .under'); "
                       "return words && !words.hidden ? words.textContent : null", plot)

    def hover(self, plot, x, y):
        """The words at a point of a figure's axes."""
        self.mouse("Moved", self.place(plot, x, y))
        return self.wait(lambda: self.words(plot), f"words over {plot}", 10)

    def download(self, figure, kind="csv"):
        self.js("document.querySelector(`[data-${arguments[1]}='${arguments[0]}']`).click()", figure, kind)
        file = self.downloads / f"{figure}.{kind}"
        self.wait(lambda: file.exists() and file.stat().st_size > 0, f"{file.name} is saved", 10)
        return file

    def pdf(self):
        return base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF",
                                                            {"printBackground": True, "preferCSSPageSize": True})[
            "data"])
