// SPDX-License-Identifier: MIT
// The page's build step puts the files together; minify leaves out comments, blanks and long names, and nothing that has a meaning.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { parse } from "acorn";
import { is_short, made_page } from "./made_page.mjs";
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

const files = fs.readFileSync(path.join(source, "order.txt"), "utf8").trim().split("\n").map(name => fs.readFileSync(path.join(source, name), "utf8")).join("");
const script_of = page => /<script>([^]*?)<\/script>/.exec(page)[1], style_of = page => /<style>([^]*?)<\/style>/.exec(page)[1];

test("page build: without minify, the script of the page is the code of all its files, in one function", () => {
    const script = script_of(made_page("whole", ""));
    assert.deepEqual(tree(script), tree(`(() => {${files}})();`));
    assert.ok(script.startsWith('"use strict";'));
});

test("page build: without minify, the style of the page has the rules of page.css", () => {
    assert.equal(rules(style_of(made_page("whole", ""))), rules(fs.readFileSync(path.join(source, "page.css"), "utf8")));
});

/** Texts of a program, and names of its members, which keep their meaning. @param {string} text */
function words(text) {
    const found = new Set();
    JSON.stringify(parse(text, { ecmaVersion: 2022 }), (key, value) => {
        if (value?.type === "TemplateElement") found.add(value.value.cooked);
        if (value?.type === "Literal" && typeof value.value === "string") found.add(value.value);
        if (value?.type === "MemberExpression" && !value.computed) found.add(value.property.name);
        return value;
    });
    return found;
}

test("page build: the minified script keeps all texts and names of members of its files", { skip: !is_short && "the page was built without minify" }, () => {
    const script = script_of(html("rescue")), short = words(script), all = [...short].join("\n");
    assert.ok(script.startsWith('"use strict";'));
    assert.ok(script.length < 0.55 * files.length);
    for (const word of words(files)) assert.ok(short.has(word) || all.includes(word), word);
});
