# SPDX-License-Identifier: GPL-3.0-or-later
"""A page in headless Chromium, without a network: scripts, pointers, pictures and what its console says."""
import pathlib

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.by import By

# Of scripts, in seconds. Chosen: software rendering on a busy machine takes a minute at most.
PATIENCE = 300


class Browser:
    """One window. Use it with `with`."""

    def __init__(self, width=1200, height=900):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        # Every host is unknown: the page has to be whole. Rendering is by the processor on every machine.
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--allow-file-access-from-files",
                         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost",
                         f"--window-size={width},{height}"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(PATIENCE)
        self.driver.set_page_load_timeout(PATIENCE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def size(self, width, height, touch=False):
        """The window as that of a screen of this size, in pixels of the page."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch})
        self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": touch})

    def open(self, page, fragment=""):
        self.driver.get("about:blank")  # so that another fragment loads the page too
        self.driver.get(pathlib.Path(page).resolve().as_uri() + fragment)

    def run(self, script, *arguments):
        """What an asynchronous function of that body returns."""
        wrapped = ("const end = arguments[arguments.length - 1];"
                   f"(async (...given) => {{{script}}})(...[...arguments].slice(0, -1))"
                   ".then((value) => end([value ?? null, null]), (fault) => end([null, String(fault.stack ?? fault)]));")
        value, fault = self.driver.execute_async_script(wrapped, *arguments)
        if fault is not None:
            raise RuntimeError(fault)
        return value

    def element(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def click(self, selector):
        self.element(selector).click()

    def drag(self, selector, start, way, steps=4, kind="mouse"):
        """Drags from a point of the element, from its upper left corner as it lies in the window."""
        box = self.run("const b = document.querySelector(given[0]).getBoundingClientRect(); return [b.x, b.y]", selector)
        pointer = PointerInput(kind, f"{kind}-1")
        builder = ActionBuilder(self.driver, mouse=pointer, duration=10)
        at = [round(box[k] + start[k]) for k in range(2)]
        builder.pointer_action.move_to_location(*at).pointer_down()
        for step in range(1, steps + 1):
            builder.pointer_action.move_to_location(*(round(at[k] + way[k] * step / steps) for k in range(2)))
        builder.pointer_action.pointer_up()
        builder.perform()

    def picture(self, path):
        """The window as a PNG."""
        path.parent.mkdir(parents=True, exist_ok=True)
        self.driver.save_screenshot(str(path))

    def cut_by(self, selector):
        """Pixels of what the element holds that lie beyond its right edge."""
        return self.run("const e = document.querySelector(given[0]); return e.scrollWidth - e.clientWidth", selector)

    def complaints(self):
        """Errors and warnings of the console since the last call."""
        return [f"{entry['level']}: {entry['message']}" for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING")]
