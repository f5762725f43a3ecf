"""A headless Chromium with a report in it."""
import pathlib
import time
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

DRIVER = pathlib.Path("/usr/bin/chromedriver")
LONGEST_WAIT = 120  # s; for hangs alone


class Browser:
    """`downloads`: the folder to which exports go."""

    def __init__(self, downloads, width=1400, height=1000):
        if not DRIVER.exists():
            raise unittest.SkipTest(f"this machine has no {DRIVER} (Debian's package chromium-driver)")
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--hide-scrollbars", "--force-prefers-reduced-motion",
                         # Pages of Chromium's own, which it would load at its start: they take longer than a report.
                         "--disable-features=WebUIOmniboxPopup,WebUIOmniboxAimPopup"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
        self.opened = 0
        self.downloads = pathlib.Path(downloads)
        self.command("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))
        self.resize(width, height)

    def command(self, name, **parameters):
        return self.driver.execute_cdp_cmd(name, parameters)

    def resize(self, width, height=1000):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait_for(self, script, *arguments):
        """Waits until the script returns something true, and returns it."""
        end = time.monotonic() + LONGEST_WAIT
        while time.monotonic() < end:
            result = self.run(f"return {script}", *arguments)
            if result:
                return result
            time.sleep(0.05)
        raise AssertionError(f"never true: {script}")

    def open(self, path, address=""):
        """A report, with all that it shows at first."""
        self.opened += 1  # in the address, since one that differs behind the # alone opens nothing
        self.driver.get(f"file://{path}?{self.opened}{address}")
        self.wait_for("document.documentElement.dataset.computer")

    def go(self, address):
        """Another address in the report that is open, as by a link that is pasted."""
        self.computes(lambda: self.run("document.activeElement.blur(); "
                                       "history.replaceState(null, '', arguments[0] || location.pathname); "
                                       "dispatchEvent(new HashChangeEvent('hashchange'))", address))

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.run("return document.querySelector(arguments[0]).textContent", selector)

    def dataset(self, name):
        return self.run("return document.documentElement.dataset[arguments[0]]", name)

    def facts(self):
        """What the point's card lists."""
        return self.run("return Object.fromEntries([...document.querySelectorAll('#facts dl > div')].map((one) =>"
                        " [one.querySelector('dt').textContent, one.querySelector('dd').textContent]))")

    def computes(self, act, times=1):
        """Does something that asks the page so many times to compute, and waits until it has answered."""
        before = self.dataset("computed") or "0"
        act()
        self.wait_for("Number(document.documentElement.dataset.computed) >= arguments[0]", int(before) + times)

    def wait_for_two_frames(self):
        """After which an animation that runs has been drawn again."""
        self.driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")

    def exported(self, kind, subject):
        """The file that a button of a panel saves."""
        for old in self.downloads.iterdir():
            old.unlink()
        button = self.find(f"button[aria-label='{kind} of {subject}']")
        self.run("arguments[0].scrollIntoView({block: 'center'})", button)
        end = time.monotonic() + LONGEST_WAIT
        while time.monotonic() < end:
            # As a user does: Chromium holds back the eleventh file that a script saves by itself. Again where nothing
            # comes, since on a busy machine the button may be moved between the aim and the click.
            button.click()
            again = time.monotonic() + LONGEST_WAIT / 4
            while time.monotonic() < again:
                files = [one for one in self.downloads.iterdir() if not one.name.endswith((".crdownload", ".tmp"))
                         and one.stat().st_size]
                if files:
                    return files[0]
                time.sleep(0.05)
        raise AssertionError(f"{kind} of {subject} was not saved")

    def pixels(self, selector):
        """The picture on a canvas, to compare with another time's."""
        return self.run("return document.querySelector(arguments[0]).toDataURL()", selector)

    def log(self):
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def close(self):
        self.driver.quit()
