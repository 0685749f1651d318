#!/usr/bin/env python3
"""Opens the 3-D view of a report in a headless Chromium that draws without a graphics card: no console message, no request outside
the sample's folder, a picture that is not empty and changes with frame, colour, object and when turned, and twice the same picture.

    browse_view.py REPORT SCREENSHOTS

Screenshots go to SCREENSHOTS. Exit 77: there is no Chromium."""
import os
import shutil
import sys
import time
import urllib.parse

import numpy as np
from browse_pages import CONTRAST, OVERFLOW, PROGRAMS, WIDTHS, Browser, event_faults

SIZE = (1000, 760)
WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
DRAWN = "document.getElementById('scene').dataset.drawn || document.getElementById('why').textContent"
# The picture as the canvas has it: width, height and the numbers of all pixels, drawn into a second canvas.
PIXELS = """(() => {
  const scene = document.getElementById('scene'), copy = document.createElement('canvas');
  [copy.width, copy.height] = [200, 150];
  const context = copy.getContext('2d');
  context.drawImage(scene, 0, 0, 200, 150);
  return Array.from(context.getImageData(0, 0, 200, 150).data);
})()"""
IMAGES = "[...document.querySelectorAll('#images img')].filter(i => i.style.visibility !== 'hidden').map(i => i.src)"
# Names of the gels, where there are several.
GELS = """document.getElementById('of-gels').hidden ? [] :
  [...document.getElementById('seen').options].slice(1).map(o => o.textContent.split(',')[0])"""
CHANGE = """(() => {{ const e = document.getElementById('{0}'); e.{1} = {2};
  e.dispatchEvent(new Event('{3}')); return true; }})()"""


class View:
    def __init__(self, browser, shots):
        self.browser, self.shots = browser, shots

    def until(self, words):
        """Waits until the last frame drawn is the one of these words."""
        for _ in range(300):
            if self.browser.value(DRAWN) == words:
                return
            time.sleep(0.1)
        raise RuntimeError(f"the view shows {self.browser.value(DRAWN)!r}, not {words!r}")

    def picture(self, name):
        self.browser.screenshot(os.path.join(self.shots, name + ".png"), *SIZE)
        # In one task with the drawing, because a canvas forgets its picture once it has been shown.
        drawn = self.browser.call("Runtime.evaluate", awaitPromise=True, returnByValue=True, expression=f"""
          new Promise(done => {{ window.dispatchEvent(new Event('resize')); requestAnimationFrame(() => done({PIXELS})); }})""")
        return np.array(drawn["result"]["value"], np.uint8).reshape(150, 200, 4)

    def change(self, element, value, event="change"):
        field = "checked" if isinstance(value, bool) else "value"
        self.browser.value(CHANGE.format(element, field, repr(value).lower() if isinstance(value, bool) else repr(value), event))


def image_faults(browser, frame):
    """Tactile images beside the view are those of its frame."""
    for name in browser.value(IMAGES):
        if f"/frame_{frame}/tactile.png" not in name:
            yield f"beside frame {frame} there is {name}"


def look(browser, url, folder, shots, faults):
    """The pictures of one visit, by what they show."""
    browser.open(url, *SIZE, False, "light")
    view, shown = View(browser, shots), {}
    last = browser.value("document.getElementById('sample').value")
    for _ in range(300):
        if browser.value(DRAWN):
            break
        time.sleep(0.1)
    frames = int(browser.value("document.getElementById('frame').max"))
    view.until(f"{last} {frames} indentation glass")
    shown["last frame"] = view.picture("last")
    view.change("frame", "0", "input")
    view.until(f"{last} 0 indentation glass")
    shown["first frame"] = view.picture("first")
    faults += image_faults(browser, "0000")
    view.change("frame", str(frames), "input")
    view.change("object", "hidden")
    view.until(f"{last} {frames} indentation hidden")
    shown["without object"] = view.picture("hidden")
    for color in ("pressure", "state"):
        view.change("color", color)
        view.until(f"{last} {frames} {color} hidden")
        shown[color] = view.picture(color)
    browser.value("document.getElementById('scene').focus()")
    browser.key("ArrowLeft", 37)
    shown["turned"] = view.picture("turned")
    view.change("lines", False)
    shown["without lines"] = view.picture("plain")
    for gel in range(len(browser.value(GELS))):  # of several, each as it is seen from its own frame
        view.change("seen", str(gel))
        view.until(f"{last}/{browser.value(GELS)[gel]} {frames} state hidden")
        shown["gel " + browser.value(GELS)[gel]] = view.picture(browser.value(GELS)[gel])
    # The driver complains of our reading the picture, not of the page.
    sample = os.path.dirname(os.path.realpath(folder))  # the images lie beside the report
    faults += [fault for fault in event_faults(browser.events, sample) if "ReadPixels" not in fault]
    return shown


def judge(shown):
    for name, picture in shown.items():
        covered = np.mean(picture[..., 3] > 0)
        if not 0.05 < covered < 0.95:
            yield f"{name}: {100 * covered:.0f} % of the picture is covered"
        if len(np.unique(picture.reshape(-1, 4), axis=0)) < 50:
            yield f"{name}: has hardly any colours"
    names = list(shown)
    for i, name in enumerate(names):
        for other in names[:i]:
            # Two gels may: what they grip can be symmetric.
            if name.startswith("gel ") and other.startswith("gel "):
                continue
            if np.mean(np.any(shown[name] != shown[other], axis=2)) < 0.001:
                yield f"{name} and {other} look the same"


def screens(browser, url):
    """What a reader on a desktop or a phone would complain of."""
    for device, (width, height, phone) in WIDTHS.items():
        for scheme in ("light", "dark"):
            browser.open(url, width, height, phone, scheme)
            wide = browser.value(OVERFLOW)
            if wide:
                yield f"{device}: is wider than the screen: {wide}"
            yield from (f"{device}, {scheme}: little contrast: {text}" for text in browser.value(CONTRAST))


def main():
    folder, shots = sys.argv[1:3]
    program = next((p for p in map(shutil.which, PROGRAMS) if p), None)
    if program is None:
        print("skipped: no Chromium (Debian package chromium-headless-shell)")
        sys.exit(77)
    os.makedirs(shots, exist_ok=True)
    url = "file://" + urllib.parse.quote(os.path.realpath(os.path.join(folder, "view.html")))
    faults, visits = [], []
    for _ in range(2):
        browser = Browser(program, *WEBGL)
        try:
            visits.append(look(browser, url, folder, shots, faults))
            if len(visits) == 2:
                faults += screens(browser, url)
        finally:
            browser.close()
    faults += judge(visits[0])
    faults += [f"{name}: two visits differ" for name in visits[0] if not np.array_equal(visits[0][name], visits[1][name])]
    browser = Browser(program, "--disable-3d-apis")
    try:
        browser.open(url, *SIZE, False, "light")
        if "WebGL" not in browser.value("document.getElementById('why').textContent") or browser.value(
                "document.getElementById('failure').hidden"):
            faults.append("without WebGL it does not say so")
    finally:
        browser.close()
    print("\n".join(faults) if faults else f"{len(visits[0])} views are fine, screenshots in {shots}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
