// SPDX-License-Identifier: MIT
// mcap_core.mjs TRACE: lists the channels of a recorded trace as @mcap/core reads them, a line each:
// number, topic and messages. Reads every chunk, and fails if the file's own statistics or its index
// of chunks tell something else.
import {McapIndexedReader, McapStreamReader} from "@mcap/core";
import {decompress} from "fzstd";
import {open, readFile} from "node:fs/promises";
import assert from "node:assert/strict";

const decompressHandlers = {zstd: (data, size) => decompress(data, new Uint8Array(Number(size)))};

async function streamed(path) {
  const channels = new Map();
  const reader = new McapStreamReader({decompressHandlers, validateCrcs: true});
  reader.append(await readFile(path));
  for (let record; (record = reader.nextRecord());) {
    const isNew = record.type === "Channel" && !channels.has(record.id);  // the summary repeats them
    if (isNew) channels.set(record.id, {topic: record.topic, messages: 0n});
    if (record.type === "Message") channels.get(record.channelId).messages++;
  }
  assert(reader.done(), "the file ends early");
  return channels;
}

async function indexed(path) {
  const file = await open(path);
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, size) => {
      const buffer = new Uint8Array(Number(size));
      await file.read(buffer, 0, Number(size), Number(offset));
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({readable, decompressHandlers});
  await file.close();
  return reader;
}

const path = process.argv[2];
const channels = await streamed(path);
const {header, statistics, channelsById} = await indexed(path);
assert.equal(header.profile, "rovernet");
assert.equal(channelsById.size, channels.size);
for (const [id, {topic, messages}] of [...channels].sort(([a], [b]) => a - b)) {
  assert.equal(channelsById.get(id).topic, topic);
  assert.equal(statistics.channelMessageCounts.get(id) ?? 0n, messages, topic);
  console.log(id, topic, messages.toString());
}
