// SPDX-License-Identifier: MIT
// foxglove.mjs FILE: reads what `trace convert --to foxglove` wrote by @mcap/core, and holds each message to
// the schema that Foxglove publishes for its type (@foxglove/schemas). Prints as JSON: messages by topic; the
// last place of each robot's coordinate frame; wall cells; lines of frames by colour.
import {McapStreamReader} from "@mcap/core";
import published from "@foxglove/schemas/jsonschema.js";
import Ajv from "ajv";
import {decompress} from "fzstd";
import {readFile} from "node:fs/promises";
import assert from "node:assert/strict";

const ajv = new Ajv({strict: false, formats: {"date-time": true}});
const validators = new Map();
const schemas = new Map();
const channels = new Map();
const found = {messages: {}, places: {}, walls: 0, lines: {}, robots: []};

// Every key of a schema of ours is one of the published schema, with the same type.
function assertPart(ours, theirs, path) {
  if (ours.type === "object" && ours.properties) {
    for (const [key, schema] of Object.entries(ours.properties)) {
      assert(theirs.properties?.[key], `${path}.${key} is not published`);
      assertPart(schema, theirs.properties[key], `${path}.${key}`);
    }
  } else if (ours.type === "array") {
    assertPart(ours.items, theirs.items, `${path}[]`);
  } else if (theirs.type) {
    assert.equal(ours.type, theirs.type, path);
  }
  assert.equal(ours.contentEncoding, theirs.contentEncoding, path);
}

function take(topic, message) {
  for (const {child_frame_id, translation} of message.transforms ?? []) found.places[child_frame_id] = translation;
  if (topic === "/map") found.walls += Buffer.from(message.data, "base64").reduce((sum, cell) => sum + cell, 0);
  for (const entity of message.entities ?? []) {
    if (topic === "/robots") found.robots.push(entity.texts[0].text);
    for (const {points, colors} of entity.lines) {
      assert.equal(points.length, colors.length);
      for (let i = 0; i < points.length; i += 2) {
        const color = JSON.stringify(colors[i]);
        found.lines[color] = (found.lines[color] ?? 0) + 1;
      }
    }
  }
}

const reader = new McapStreamReader({
  decompressHandlers: {zstd: (data, size) => decompress(data, new Uint8Array(Number(size)))},
  validateCrcs: true,
});
reader.append(await readFile(process.argv[2]));
let last = -1n;
for (let record; (record = reader.nextRecord());) {
  if (record.type === "Schema" && !schemas.has(record.id)) {
    assert.equal(record.encoding, "jsonschema");
    const theirs = published[record.name.replace("foxglove.", "")];
    assertPart(JSON.parse(new TextDecoder().decode(record.data)), theirs, record.name);
    validators.set(record.id, ajv.compile(theirs));
    schemas.set(record.id, record.name);
  } else if (record.type === "Channel") {
    assert.equal(record.messageEncoding, "json");
    channels.set(record.id, record);
  } else if (record.type === "Message") {
    const {topic, schemaId} = channels.get(record.channelId);
    assert(record.logTime >= last, "messages are out of order");
    last = record.logTime;
    const message = JSON.parse(new TextDecoder().decode(record.data));
    const isValid = validators.get(schemaId);
    assert(isValid(message), `${topic}: ${ajv.errorsText(isValid.errors)}`);
    found.messages[topic] = (found.messages[topic] ?? 0) + 1;
    take(topic, message);
  }
}
assert(reader.done(), "the file ends early");
console.log(JSON.stringify(found));
