// SPDX-License-Identifier: MIT
// All tests of the viewer, in one process: they share a browser.
import fs from "node:fs";
import path from "node:path";

const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
for (const file of fs.readdirSync(here).sort()) {
    if (file.endsWith("_test.mjs")) await import(path.join(here, file));
}
