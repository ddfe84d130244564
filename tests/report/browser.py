"""A page in headless Chromium, as a reader meets it: opened from the disk, without a network, with everything the
console says."""
import base64
import json
import pathlib
import shutil
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

    def hover(self, plot, x, y):
        """The words at a point of a figure's axes."""
        place = self.js(
            """const g = document.getElementById(arguments[0]);
               g.scrollIntoView({block: 'center', behavior: 'instant'});
               const f = g._fullLayout, box = g.getBoundingClientRect();
               return [box.left + f.xaxis._offset + f.xaxis.d2p(arguments[1]),
                       box.top + f.yaxis._offset + f.yaxis.d2p(arguments[2])];""", plot, x, y)
        for step in (3, 0):  # a pointer that only appears does not move
            self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": place[0] + step,
                                                                     "y": place[1]})
            time.sleep(0.2)  # words follow a pointer at rest
        return self.wait(
            lambda: self.js(
            "return [...document.querySelectorAll('#' + arguments[0] + ' .hoverlayer .hovertext')].map(e => "
            "e.textContent).join(' ')", plot), f"words over {plot}", 10)

    def download(self, figure):
        self.js("document.querySelector(`[data-csv='${arguments[0]}']`).click()", figure)
        file = self.downloads / f"{figure}.csv"
        self.wait(lambda: file.exists() and file.stat().st_size > 0, f"{file.name} is saved", 10)
        return file

    def pdf(self):
        return base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF",
                                                            {"printBackground": True, "preferCSSPageSize": True})[
            "data"])
