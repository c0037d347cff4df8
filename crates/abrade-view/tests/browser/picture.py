"""Takes a picture of a page, as docs/view.png is taken:

    python3 crates/abrade-view/tests/browser/picture.py runs/first/view.html docs/view.png
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from devtools import Browser, NoBrowser

if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        with Browser() as browser:
            browser.resize(1360, 800)
            browser.open(sys.argv[1], "document.body && document.body.dataset.ready")
            Path(sys.argv[2]).write_bytes(browser.picture())
    except NoBrowser as error:
        sys.exit(str(error))
