// SPDX-License-Identifier: MIT
// The page's build step leaves out comments and blanks, and nothing that has a meaning.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { parse } from "acorn";
import { html } from "./run_file.mjs";

const source = process.env.PAGE;
/** A program as its tree, without places. @param {string} text */
function tree(text) {
    const is_strict = node => node.type === "ExpressionStatement" && node.directive === "use strict";
    return JSON.parse(JSON.stringify(parse(text, { ecmaVersion: 2022 }), (key, value) => {
        if (["start", "end"].includes(key)) return undefined;
        if (value?.type === "Literal") return { type: "Literal", raw: value.raw };  // with the regular expressions
        return Array.isArray(value) ? value.filter(node => !node || !is_strict(node)) : value;
    }));
}

/** Rules of a style, without blanks that have no meaning. @param {string} text */
function rules(text) {
    return text.replace(/\/\*[^]*?\*\//g, "").replace(/\s+/g, " ").replace(/ ?([{};:,]) ?/g, "$1").replaceAll(";}", "}").trim();
}

test("the script of the page is the program of its files, texts and all", () => {
    const names = fs.readFileSync(path.join(source, "order.txt"), "utf8").trim().split("\n");
    const files = names.map(name => fs.readFileSync(path.join(source, name), "utf8")).join("");
    const script = /<script>([^]*?)<\/script>/.exec(html("rescue"))[1];
    assert.deepEqual(tree(script), tree(files));
    assert.ok(script.startsWith('"use strict";'));
    assert.ok(script.length < 0.75 * files.length);
});

test("the style of the page is that of its file", () => {
    const style = /<style>([^]*?)<\/style>/.exec(html("rescue"))[1];
    assert.equal(rules(style), rules(fs.readFileSync(path.join(source, "page.css"), "utf8")));
});
