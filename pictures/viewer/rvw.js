// SPDX-License-Identifier: MIT
// View file: head and columns of a run, as in docs/formats/view-format.md.
/** @typedef {{name: string, type: string, count: number, offset: number, bytes: number, raw?: boolean}} Section */
/** @typedef {{name: string, radius: number, model: string, power_dbm: number, sensitivity_dbm: number, antenna_z: number, antenna?: number}} Robot */
/** @typedef {{name: string, floor: number, x0: number, y0: number, x1: number, y1: number, closed: boolean}} Door */
/** @typedef {{foot: number[], head: number[]}} Stairs */
/** @typedef {{bounds: number[], open_field: boolean, floors: number[], materials: {name: string, style: number}[], doors: Door[], stairs: Stairs[]}} PlaceMap */
/** @typedef {{category: string[], lagoon: string[], ember: string[], balance: string[], links: {from_db: number, width: number, color: string}[], walls: {color: string, hatch: string|null}[], door: string, stairs: string, robot: string, outcomes: string[]}} Colors */
/** @typedef {{begin_ns: number, end_ns: number, flights: number, receptions: number}} BlockInfo */
/** @typedef {{message: number, robot: number, outcome: string, text: string}} Answer */
/** @typedef {{rvw: number, version: string, name: string, seed: number, replication: number, duration_ns: number, robots: Robot[], antennas: number[][], map: PlaceMap, colors: Colors, models: string[], outcomes: string[], drops: {code: string, layer: string, text: string}[], frame_kinds: string[], message_kinds: string[], flows: string[], blocks: BlockInfo[], counts: {flights: number, receptions: number, messages: number, legs: number, outcomes: number[]}, metrics: Record<string, unknown>, series: Series[], density: {bins: number, width_ns: number, begin?: number}[], live?: Live, thinned: string[], damage: string[], follow: Answer[], sections: Section[]}} Head */
/** @typedef {Uint8Array|Uint16Array|Uint32Array|Float32Array|Float64Array} Numbers */
/** @typedef {{head: Head, sections: Map<string, Section>, body: Uint8Array, inflate: Inflate}} ViewFile */
/** @typedef {(packed: Uint8Array, bytes: number) => Promise<Uint8Array>} Inflate */
const rvw = (() => {
    "use strict";

    /** Sentence about a file that cannot be shown. */
    class ViewError extends Error {}

    const version = 1;
    /** Most bytes that DEFLATE makes of one. */
    const best_ratio = 1032;
    /** @type {Record<string, any>} */
    const types = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array, time: Float64Array, text: Uint32Array };

    /** @param {string} sentence @returns {never} */
    function refuse(sentence) { throw new ViewError(sentence); }

    /** @param {string} what @returns {never} */
    function damaged(what) { return refuse(`The view file is damaged: ${what}`); }

    /** @param {string} name of a column whose length, type or values are wrong @returns {never} */
    function broken(name) { return damaged(`its column ${name} is wrong.`); }

    /** @param {Uint8Array} packed @param {number} bytes most that may come out */
    async function inflate(packed, bytes) {
        const out = new Uint8Array(bytes);
        const { body } = new Response(new Uint8Array(packed));  // a Blob takes a millisecond
        const reader = /** @type {ReadableStream} */ (body).pipeThrough(new DecompressionStream("deflate-raw")).getReader();
        let at = 0;
        for (;;) {
            const { done, value } = await reader.read();
            if (done) return out.subarray(0, at);
            if (at + value.length > bytes) {
                await reader.cancel();
                return refuse("");
            }
            out.set(value, at);
            at += value.length;
        }
    }

    /** @param {Uint8Array} bytes @param {Inflate} [unpack] @param {(head: any) => string} [fault] finds a wrong part of the head @returns {ViewFile} */
    function open(bytes, unpack = inflate, fault = head_check.fault) {
        if (bytes.length < 8 || String.fromCharCode(...bytes.subarray(0, 4)) !== "RVW1") {
            refuse("This is no view file: it does not begin with RVW1.");
        }
        const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(4, true);
        if (length > bytes.length - 8) refuse("The view file is cut off within its head.");
        let head;
        try {
            head = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + length)));
        } catch {
            damaged("its head is no JSON.");
        }
        if (head?.rvw !== version) {
            refuse(`The view file has format ${head?.rvw}; this page reads ${version}.`);
        }
        const body = bytes.subarray(8 + length);
        const wrong = fault(head);
        if (wrong) damaged(`its head has no usable ${wrong}.`);
        const sections = new Map();
        for (const s of head.sections) {
            const good = s && typeof s.name === "string" && Object.hasOwn(types, s.type) &&
                [s.count, s.offset, s.bytes].every(head_check.count);
            if (!good) damaged("its list of columns is broken.");
            if (s.offset + s.bytes > body.length) refuse(`The view file is cut off: ${s.name} lies beyond its end.`);
            sections.set(s.name, s);
        }
        return { head, sections, body, inflate: unpack };
    }

    /** @param {ViewFile} file @param {string} name @returns {Promise<{section: Section, bytes: Uint8Array}>} */
    async function unpacked(file, name) {
        const section = file.sections.get(name);
        if (!section) return broken(name);
        const size = types[section.type].BYTES_PER_ELEMENT;
        if (section.raw) {
            if (section.type !== "text" && section.bytes !== size * section.count) return broken(name);
            return { section, bytes: file.body.slice(section.offset, section.offset + section.bytes) };
        }
        const most = section.type === "text" ? best_ratio * section.bytes + 64 : size * section.count;
        if (most > best_ratio * section.bytes + 64) return broken(name);
        const packed = file.body.subarray(section.offset, section.offset + section.bytes);
        let bytes;
        try {
            bytes = await file.inflate(packed, most);
        } catch {
            return broken(name);
        }
        if (section.type !== "text" && bytes.length !== most) return broken(name);
        return { section, bytes: bytes.byteOffset % 8 ? bytes.slice() : bytes };
    }

    /** @param {Uint8Array} bytes @param {number} count */
    function times(bytes, count) {
        const parts = new Uint32Array(bytes.buffer, bytes.byteOffset, 2 * count);
        const out = new Float64Array(count);
        let t = 0;
        for (let i = 0; i < count; i++) {
            t += parts[i] + 4294967296 * parts[count + i];
            out[i] = t;
        }
        return t <= Number.MAX_SAFE_INTEGER ? out : damaged("a time is too large.");
    }

    /** Column of numbers. @param {ViewFile} file @param {string} name @param {string} [type] that it must have @returns {Promise<Numbers>} */
    async function column(file, name, type) {
        const { section, bytes } = await unpacked(file, name);
        if (type && section.type !== type || section.type === "text") return broken(name);
        if (section.type === "time") return times(bytes, section.count);
        return new types[section.type](bytes.buffer, bytes.byteOffset, section.count);
    }

    /** Texts, decoded when asked for. @param {ViewFile} file @param {string} name @returns {Promise<(i: number) => string>} */
    async function texts(file, name) {
        const { section, bytes } = await unpacked(file, name);
        const start = 4 * (section.count + 1);
        if (section.type !== "text" || bytes.length < start) return broken(name);
        const offsets = new Uint32Array(bytes.buffer, bytes.byteOffset, section.count + 1);
        const decoder = new TextDecoder();
        return i => decoder.decode(bytes.subarray(start + offsets[i], start + offsets[i + 1]));
    }

    return { ViewError, refuse, broken, open, column, texts };
})();
