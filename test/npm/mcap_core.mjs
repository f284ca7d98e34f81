// SPDX-License-Identifier: MIT
// mcap_core.mjs TRACE: lists the channels of a recorded trace as @mcap/core reads them, a line each:
// number, topic and messages. Reads every message twice, one behind the other and by the indexes, and
// fails if the file's own statistics or its indexes tell something else.
import {McapIndexedReader, McapStreamReader} from "@mcap/core";
import {decompress} from "fzstd";
import {createHash} from "node:crypto";
import {open, readFile} from "node:fs/promises";
import assert from "node:assert/strict";

const decompressHandlers = {zstd: (data, size) => decompress(data, new Uint8Array(Number(size)))};

function count(channel, {logTime, data}) {
  channel.messages++;
  channel.hash.update(`${logTime} `).update(data);
}

async function streamed(path) {
  const channels = new Map();
  const reader = new McapStreamReader({decompressHandlers, validateCrcs: true});
  reader.append(await readFile(path));
  for (let record; (record = reader.nextRecord());) {
    const isNew = record.type === "Channel" && !channels.has(record.id);  // the summary repeats them
    if (isNew) channels.set(record.id, {topic: record.topic, messages: 0n, hash: createHash("sha1")});
    if (record.type === "Message") count(channels.get(record.channelId), record);
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
  const found = new Map();
  let last = 0n;
  for await (const message of reader.readMessages()) {
    assert(message.logTime >= last, "the index is out of order");
    last = message.logTime;
    const {channelId} = message;
    if (!found.has(channelId)) found.set(channelId, {messages: 0n, hash: createHash("sha1")});
    count(found.get(channelId), message);
  }
  let later = 0n; // messages of one topic from a time on
  for await (const message of reader.readMessages({topics: ["Sent"], startTime: last / 2n})) {
    assert(message.logTime >= last / 2n);
    later++;
  }
  await file.close();
  return {...reader, found, later};
}

const path = process.argv[2];
const channels = await streamed(path);
const {header, statistics, channelsById, found, later} = await indexed(path);
assert.equal(header.profile, "rovernet");
assert.equal(channelsById.size, channels.size);
assert(later > 0n && later < statistics.messageCount);
for (const [id, {topic, messages, hash}] of [...channels].sort(([a], [b]) => a - b)) {
  assert.equal(channelsById.get(id).topic, topic);
  assert.equal(statistics.channelMessageCounts.get(id) ?? 0n, messages, topic);
  assert.equal(found.get(id)?.messages ?? 0n, messages, topic);
  if (messages > 0n) assert.equal(found.get(id).hash.digest("hex"), hash.digest("hex"), topic);
  console.log(id, topic, messages.toString());
}
