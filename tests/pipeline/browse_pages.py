#!/usr/bin/env python3
"""Opens pages in a headless Chromium, as a desktop and a phone show them, light and dark, and complains of what a reader would:
a page wider than the screen, console messages, requests that leave the folder, text of little contrast, a keyboard that gets stuck.

    browse_pages.py FOLDER SCREENSHOTS PAGE...

Pages are named as seen from FOLDER; of every page in it links and pictures are looked up too. Screenshots go to SCREENSHOTS.
Exit 77: there is no Chromium. Speaks with the browser through its DevTools pipe, so it needs nothing but Python."""
import base64
import html.parser
import json
import os
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

WIDTHS = {"desktop": (1280, 900, False), "phone": (390, 844, True)}
SCHEMES = ("light", "dark")
PROGRAMS = ("chromium-headless-shell", "chromium")

# Text whose contrast (WCAG 2.1) is below 4.5, as "tag: text: contrast". SVG text is judged by its fill.
CONTRAST = """(() => {
  const numbers = s => { const m = s.match(/rgba?\\(([^)]+)\\)/); if (!m) return null;
    const p = m[1].split(/[ ,\\/]+/).map(Number); return p.length < 4 ? [...p, 1] : p; };
  const linear = c => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const light = c => 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
  const paper = e => { for (; e; e = e.parentElement) { const c = numbers(getComputedStyle(e).backgroundColor);
    if (c && c[3] === 1) return c; } return [255, 255, 255, 1]; };
  const faults = [];
  for (const e of document.querySelectorAll('body *')) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.data.trim()) || e.closest('title')) continue;
    const style = getComputedStyle(e), ink = numbers(e.closest('svg') ? style.fill : style.color);
    if (!ink || style.visibility === 'hidden' || style.display === 'none') continue;
    const a = light(ink), b = light(paper(e)), contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (contrast < 4.5) faults.push(e.tagName + ': ' + e.textContent.trim().slice(0, 30) + ': ' + contrast.toFixed(2));
  }
  return faults.slice(0, 5);
})()"""

# What has the focus: nothing at the end of the page, else what it is, whether one sees it and that it has the focus.
FOCUSED = """(() => {
  const e = document.activeElement;
  if (!e || e === document.body || e === document.documentElement) return null;
  const box = e.getBoundingClientRect(), style = getComputedStyle(e);
  return {name: e.tagName + ' ' + (e.getAttribute('href') || e.getAttribute('aria-label') || e.textContent.trim()).slice(0, 60),
    seen: box.width > 0 && box.height > 0 && box.right > 0 && box.bottom > 0 && box.left < innerWidth && box.top < innerHeight,
    marked: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) > 0};
})()"""

FOCUSABLE = "[...document.querySelectorAll('a[href], summary, [tabindex=\"0\"]')].filter(e => e.getClientRects().length).length"
OVERFLOW = """(() => {
  const root = document.documentElement;
  if (root.scrollWidth <= root.clientWidth) return null;
  const far = [...document.querySelectorAll('body *')].filter(e => !e.closest('.scroll')).find(e => e.getBoundingClientRect().right > root.clientWidth + 1);
  return root.scrollWidth + ' px in ' + root.clientWidth + (far ? ': ' + far.tagName + '.' + far.className : '');
})()"""


class Browser:
    def __init__(self, program, *flags):
        to_browser, self.write = os.pipe()
        self.read, from_browser = os.pipe()
        self.profile = tempfile.mkdtemp()

        def wire():  # DevTools reads from 3 and writes to 4
            a, b = os.dup(to_browser), os.dup(from_browser)
            os.dup2(a, 3)
            os.dup2(b, 4)

        command = [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                   "--remote-debugging-pipe", f"--user-data-dir={self.profile}", *flags, "about:blank"]
        self.process = subprocess.Popen(command, preexec_fn=wire, close_fds=False, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer, self.count, self.events = b"", 0, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def message(self):
        while b"\0" not in self.buffer:
            part = os.read(self.read, 1 << 20)
            if not part:
                raise RuntimeError("the browser is gone")
            self.buffer += part
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **params):
        self.count += 1
        request = {"id": self.count, "method": method, "params": params}
        if getattr(self, "session", None):
            request["sessionId"] = self.session
        os.write(self.write, json.dumps(request).encode() + b"\0")
        while True:
            answer = self.message()
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def wait(self, method):
        while not any(e.get("method") == method for e in self.events):
            self.events.append(self.message())

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(str(result["exceptionDetails"]))
        return result["result"].get("value")

    def open(self, url, width, height, phone, scheme):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        for place in ("about:blank", url):
            self.events = []
            self.call("Page.navigate", url=place)
            self.wait("Page.loadEventFired")

    def key(self, name, code):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode=code,
                      **({"text": "\r"} if name == "Enter" and kind == "keyDown" else {}))

    def screenshot(self, path, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        picture = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=True,
                            clip={"x": 0, "y": 0, "width": width, "height": height, "scale": 1})
        with open(path, "wb") as file:
            file.write(base64.b64decode(picture["data"]))

    def close(self):
        try:
            self.call("Browser.close")
        except (RuntimeError, OSError):
            pass
        self.process.wait(timeout=30)
        shutil.rmtree(self.profile, ignore_errors=True)


def event_faults(events, folder):
    home = "file://" + urllib.parse.quote(os.path.realpath(folder)) + "/"
    for event in events:
        params, kind = event.get("params", {}), event.get("method")
        if kind == "Network.requestWillBeSent":
            url = params["request"]["url"]
            if not url.startswith((home, "data:")):
                yield f"asks for {url}"
        elif kind == "Network.loadingFailed":
            yield f"cannot load something: {params.get('errorText')}"
        elif kind == "Log.entryAdded":
            yield f"log: {params['entry']['text']}"
        elif kind == "Runtime.consoleAPICalled":
            yield f"console: {params['args']}"
        elif kind == "Runtime.exceptionThrown":
            yield "a script failed"


def keyboard_faults(browser, many):
    """Tab goes through everything that can be followed, in sight and marked; the first link skips to the content."""
    wanted, reached = browser.value(FOCUSABLE), 0
    for _ in range(min(wanted, many) + 1):
        browser.key("Tab", 9)
        focused = browser.value(FOCUSED)
        if focused is None:
            break
        reached += 1
        if reached == 1:
            if "#main" not in focused["name"]:
                yield f"the first thing reached is {focused['name']}"
        if not focused["seen"]:
            yield f"{focused['name']} has the focus out of sight"
        if not focused["marked"]:
            yield f"{focused['name']} does not show that it has the focus"
    if reached < min(wanted, many):
        yield f"{reached} of {wanted} links are reached with the keyboard"
    browser.value("document.querySelector('.skip').focus()")
    browser.key("Enter", 13)
    if browser.value("location.hash") != "#main":
        yield "the link that skips to the content does not"


class Links(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.ids, self.faults, self.levels = [], set(), [], []
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag == "script":
            self.faults.append("has a script")
        if tag == "img" and not attrs.get("alt"):
            self.faults.append(f"picture without words: {attrs.get('src')}")
        if tag == "svg" and not attrs.get("aria-label") and attrs.get("aria-hidden") != "true":
            self.faults.append("drawing without words")
        if "id" in attrs:
            if attrs["id"] in self.ids:
                self.faults.append(f"two things have the id {attrs['id']}")
            self.ids.add(attrs["id"])
        self.links += [attrs[a] for a in ("href", "src") if a in attrs]


def link_faults(folder):
    pages = {}
    for root, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(root, name)
                pages[os.path.realpath(path)] = Links(path)
    for path, page in pages.items():
        yield from (f"{os.path.relpath(path, folder)}: {fault}" for fault in page.faults)
        for link in page.links:
            if link.startswith("data:"):
                continue
            parts = urllib.parse.urlsplit(link)
            target = os.path.realpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(parts.path))) if parts.path else path
            if parts.scheme or not os.path.exists(target):
                yield f"{os.path.relpath(path, folder)}: {link} leads nowhere"
            elif parts.fragment and target in pages and parts.fragment not in pages[target].ids:
                yield f"{os.path.relpath(path, folder)}: {link}: there is no such place"


def main():
    folder, shots, pages = sys.argv[1], sys.argv[2], sys.argv[3:]
    faults = list(link_faults(folder))
    program = next((p for p in map(shutil.which, PROGRAMS) if p), None)
    if program is None:
        print("\n".join(faults) + "\nskipped: no Chromium (Debian package chromium-headless-shell)")
        sys.exit(1 if faults else 77)
    os.makedirs(shots, exist_ok=True)
    browser = Browser(program)
    try:
        for page in pages:
            url = "file://" + urllib.parse.quote(os.path.realpath(os.path.join(folder, page)))
            for device, (width, height, phone) in WIDTHS.items():
                for scheme in SCHEMES:
                    browser.open(url, width, height, phone, scheme)
                    here = []
                    overflow = browser.value(OVERFLOW)
                    if overflow:
                        here.append("is wider than the screen: " + overflow)
                    here += ["little contrast: " + c for c in browser.value(CONTRAST)]
                    if scheme == "light":
                        here += keyboard_faults(browser, 60)
                    here += event_faults(browser.events, folder)
                    faults += [f"{page} ({device}, {scheme}): {fault}" for fault in here]
                    tall = min(int(browser.value("document.documentElement.scrollHeight")), 16000)
                    name = os.path.splitext(page)[0].replace("/", "_")
                    browser.screenshot(os.path.join(shots, f"{name}_{device}_{scheme}.png"), width, tall)
    finally:
        browser.close()
    print("\n".join(faults) if faults else f"{len(pages)} pages are fine, screenshots in {shots}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
