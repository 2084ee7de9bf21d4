"""Opens a report in headless Chromium as a reader would, and prints what it shows as JSON or takes a picture of it.

    report_page.py REPORT.html [SCREENSHOT.png [HEIGHT]]
"""

import json
import pathlib
import shutil
import sys

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

# Share of the picture that the vesicle covers, number of colours in it, and a sum that another picture does not have.
PIXELS = """
const view = document.getElementById("view"), gl = view.getContext("webgl");
const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight, pixels = new Uint8Array(4 * width * height);
gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
let covered = 0, sum = 0;
const colours = new Set();
for (let i = 0; i < pixels.length; i += 4) {
  if (pixels[i + 3] === 0) continue;
  ++covered;
  colours.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
  sum = (sum * 31 + (pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]) + i) % 4294967291;
}
return {covered: covered / (width * height), colours: colours.size, sum};
"""

# Extents of the surface that is drawn.
EXTENTS = """
const x = window.vehdReport.viewer.mesh.positions, low = [Infinity, Infinity, Infinity], high = low.map((v) => -v);
x.forEach((value, i) => {
  low[i % 3] = Math.min(low[i % 3], value);
  high[i % 3] = Math.max(high[i % 3], value);
});
return high.map((value, c) => value - low[c]);
"""

VALUES = "return [Math.min(...window.vehdReport.viewer.mesh.values), Math.max(...window.vehdReport.viewer.mesh.values)];"


def open_browser():
    # Without a graphics card the page itself is painted faster by the processor alone than by one that is simulated.
    options = Options()
    for switch in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                   "--enable-unsafe-swiftshader", "--disable-gpu-rasterization", "--disable-dev-shm-usage",
                   "--window-size=1200,1000"):
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def state(browser):
    return {"pixels": browser.execute_script(PIXELS), "extents": browser.execute_script(EXTENTS),
            "values": browser.execute_script(VALUES), "time": browser.find_element(By.ID, "clock").text,
            "label": browser.find_element(By.ID, "view").get_attribute("aria-label")}


def look_at(browser):
    result = {"ready": browser.execute_script("return document.documentElement.dataset.ready"),
              "title": browser.title,
              "problem": browser.find_element(By.ID, "problem").text,
              "verdict": browser.find_element(By.ID, "verdict").text,
              "plots": [plot.get_attribute("aria-label")
                        for plot in browser.find_elements(By.CSS_SELECTOR, "figure svg[role=img]")],
              "shapes": len(browser.find_elements(By.CSS_SELECTOR, "#shapes img")),
              "fields": [option.text for option in browser.find_elements(By.CSS_SELECTOR, "#field option")],
              "wider_than_window": browser.execute_script(
                  "return document.documentElement.scrollWidth > document.documentElement.clientWidth")}
    result["start"] = state(browser)
    slider = browser.find_element(By.ID, "time")
    slider.send_keys(Keys.END)
    result["end"] = state(browser)
    view = browser.find_element(By.ID, "view")
    view.send_keys(Keys.ARROW_LEFT * 6)
    result["turned"] = state(browser)
    view.send_keys("0")
    result["returned"] = state(browser)
    browser.execute_script("const f = document.getElementById('field');"
                           "f.selectedIndex = Math.max(0, f.options.length - 2);"
                           "f.dispatchEvent(new Event('change'));")
    result["recoloured"] = state(browser)
    browser.find_element(By.ID, "play").click()
    result["playing"] = browser.find_element(By.ID, "play").text
    browser.find_element(By.ID, "play").click()
    # Warnings of the software renderer about itself are no errors of the page.
    result["errors"] = [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
    return result


def photograph(browser, screenshot, height=None):
    browser.execute_script("window.vehdReport.show(Math.floor(window.vehdReport.run.surface.times.length / 4));"
                           "const f = document.getElementById('field'); f.selectedIndex = 0;"
                           "f.dispatchEvent(new Event('change'));")
    browser.execute_script("window.scrollTo(0, 0)")
    whole = browser.execute_script("return document.documentElement.scrollHeight") + 100
    browser.set_window_size(1200, int(height or whole))
    browser.save_screenshot(screenshot)


def main():
    browser = open_browser()
    try:
        browser.get(pathlib.Path(sys.argv[1]).resolve().as_uri())
        if len(sys.argv) > 2:
            photograph(browser, *sys.argv[2:])
        else:
            print(json.dumps(look_at(browser)))
    finally:
        browser.quit()


main()
