"""A local page as headless Chromium shows it: what it says of itself, what goes wrong, whether it fits the window."""

import json
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

CHROMIUM = shutil.which("chromium")
PHONE, DESKTOP = (390, 844), (1300, 900)  # CSS pixels
PATIENCE = 120  # s

# Runs after the page's own scripts and writes down what the page looks like.
OBSERVER = """<script>
addEventListener("error", event => (window.seenErrors ??= []).push(event.message));
addEventListener("load", () => setTimeout(() => {
  const images = [...document.images].filter(image => !image.complete || image.naturalWidth === 0);
  document.documentElement.dataset.seen = JSON.stringify({
    errors: window.seenErrors ?? [],
    broken_images: images.map(image => image.alt),
    images: document.images.length,
    wider_by: document.documentElement.scrollWidth - innerWidth,
    background: getComputedStyle(document.body).backgroundColor,
    data: {...document.documentElement.dataset},
  });
}, 1000));
</script>"""


@dataclass(frozen=True)
class Seen:
    errors: list[str]  # of scripts, and of the console
    broken_images: list[str]
    images: int
    wider_by: int  # CSS pixels that the page is wider than the window
    background: str  # "rgb(255, 255, 255)"
    data: dict[str, str]  # data-... of <html>


def _chromium(arguments: list[str], window: tuple[int, int], dark: bool) -> subprocess.CompletedProcess[str]:
    assert CHROMIUM is not None
    # software rendering, as there is no screen; a profile of its own, as several may run
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [
                CHROMIUM,
                "--headless=new",
                "--no-sandbox",
                "--use-gl=angle",
                "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader",
                "--hide-scrollbars",
                f"--user-data-dir={profile}",
                f"--window-size={window[0]},{window[1]}",
                f"--blink-settings=preferredColorScheme={0 if dark else 1}",
                "--virtual-time-budget=20000",
                "--enable-logging=stderr",
                *arguments,
            ],
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=False,
        )


def look(
    page: Path, window: tuple[int, int] = DESKTOP, dark: bool = False, fragment: str = "", style: str = ""
) -> Seen:
    """Opens a copy of the page with the observer in it; `style` is added to its own, to break it on purpose."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "page.html"
        text = page.read_text()
        copy.write_text(
            text.replace("<head>", f"<head>{OBSERVER}", 1).replace("</style>", style + "</style>", 1)
        )
        run = _chromium(["--dump-dom", copy.as_uri() + fragment], window, dark)
    found = re.search(r'data-seen="([^"]*)"', run.stdout)
    if found is None:
        raise RuntimeError(f"Chromium shows nothing: {run.stderr[-2000:]}")
    seen = json.loads(found.group(1).replace("&quot;", '"').replace("&amp;", "&"))
    console = re.findall(r"CONSOLE.*?\] (.*)", run.stderr)
    seen["errors"] += [line for line in console if re.search(r"error|failed|refused", line, re.IGNORECASE)]
    return Seen(**seen)


def photograph(page: Path, picture: Path, window: tuple[int, int] = DESKTOP, dark: bool = False) -> None:
    """The page as PNG."""
    _chromium([f"--screenshot={picture}", page.as_uri()], window, dark)
    if not picture.exists():
        raise RuntimeError(f"Chromium made no picture of {page}")
