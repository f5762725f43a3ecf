"""A picture of a report as a browser shows it, with a blade in contact:

    screenshot.py REPORT.html PICTURE.png [ADDRESS]
"""
import base64
import pathlib
import sys
import tempfile

from browser import Browser

HEIGHT = 1900  # of the picture, for all panels but the tables


def draw(report, picture, address=""):
    with tempfile.TemporaryDirectory() as downloads:
        browser = Browser(downloads, 1400, HEIGHT)
        try:
            browser.open(pathlib.Path(report).resolve(), address)
            # To a touch-down, and slowly on until the blade bears more than twenty newtons.
            browser.run("document.getElementById('rate').value = 2; document.getElementById('rate').oninput()")
            browser.find("#step").click()
            browser.find("#play").click()
            browser.wait_for("/ [2-9]\\d(\\.\\d+)? N/.test(document.getElementById('rotor-status').textContent)")
            browser.find("#play").click()
            browser.run("document.activeElement.blur()")
            shot = browser.command("Page.captureScreenshot", format="png",
                                   clip={"x": 0, "y": 0, "width": 1400, "height": HEIGHT, "scale": 0.75})
            pathlib.Path(picture).write_bytes(base64.b64decode(shot["data"]))
        finally:
            browser.close()


if __name__ == "__main__":
    draw(*sys.argv[1:])
