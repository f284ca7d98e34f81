// SPDX-License-Identifier: MIT
// Pages as cmake/viewer.cmake makes them, and whether the command has a page that minify made short.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { html } from "./run_file.mjs";

const { FOLDER: folder, PAGE: page } = process.env;
const found = name => execFileSync("which", [name], { encoding: "utf8" }).trim();

/** Whether the command was built with minify. */
export const is_short = !html("rescue").includes("// SPDX-License-Identifier: MIT\n");
/** Program that made the command's page short, "" if none did. */
export const minify = is_short ? found("minify") : "";

/** Page that cmake makes now, with nothing but minify at hand. @param {string} name of its file @param {string} by path of minify, or "" */
export function made_page(name, by) {
    const source = path.resolve(page), out = path.join(folder, `${name}.cpp`);
    execFileSync(found("cmake"), [`-DFOLDER=${source}`, `-DOUT=${out}`, `-DMINIFY=${by}`, "-P", path.join(source, "../../cmake/viewer.cmake")], { env: { PATH: "/nowhere" } });
    return [...fs.readFileSync(out, "utf8").matchAll(/R"page\(([^]*?)\)page"/g)].map(part => part[1]).join("");
}
