// SPDX-License-Identifier: MIT
// Picture of pixels for thousands of small shapes: a path of so many takes the browser ten times as long.
/** Pixels that a shape covers: how far from its middle, and how much of each, of 255. @typedef {{dx: Int16Array, dy: Int16Array, offset: Int32Array, cover: Uint8Array, reach: number}} Stamp */
const pixels = (() => {
    "use strict";
    const parts = 4;          // of a pixel, at which squares begin
    const largest_ring = 60;  // [px], radius
    const ring_alpha = 0.6;
    /** @type {{canvas: HTMLCanvasElement|null, image: ImageData|null, words: Int32Array, width: number, height: number, size: number, squares: Stamp[], shapes: Map<number, Stamp>, ratio: number}} */
    const own = { canvas: null, image: null, words: new Int32Array(0), width: 0, height: 0, size: 0, squares: [], shapes: new Map(), ratio: 1 };
    /** Rows and columns that are not clear, now and in the picture before. */
    const box = { left: 0, top: 0, right: 0, bottom: 0 }, last = { ...box };

    /** @param {number} reach @param {(dx: number, dy: number) => number} share of a pixel that is covered @returns {Stamp} */
    function stamp_of(reach, share) {
        /** @type {number[]} */ const dx = [];
        /** @type {number[]} */ const dy = [];
        /** @type {number[]} */ const cover = [];
        for (let y = -reach; y <= reach; y++) {
            for (let x = -reach; x <= reach; x++) {
                const part = Math.round(255 * Math.min(1, share(x, y)));
                if (part > 0) dx.push(x), dy.push(y), cover.push(part);
            }
        }
        return { dx: Int16Array.from(dx), dy: Int16Array.from(dy), offset: Int32Array.from(dx, (x, i) => dy[i] * own.width + x), cover: Uint8Array.from(cover), reach };
    }

    /** Squares of a size with their middles at each part of a pixel. @param {number} size [px] */
    function squares_of(size) {
        /** @param {number} middle @param {number} pixel */
        const covered = (middle, pixel) => Math.max(0, Math.min(pixel + 1, middle + size / 2) - Math.max(pixel, middle - size / 2));
        return Array.from({ length: parts * parts }, (_, i) => stamp_of(Math.ceil(size / 2) + 1,
            (x, y) => covered((i % parts + 0.5) / parts, x) * covered((Math.floor(i / parts) + 0.5) / parts, y)));
    }

    /** @param {number} radius [px] in halves @param {number} width [px] */
    function ring_of(radius, width) {
        return stamp_of(Math.ceil(radius + width), (x, y) => ring_alpha * Math.max(0, width / 2 + 0.5 - Math.abs(Math.hypot(x + 0.5, y + 0.5) - radius)));
    }

    /** @param {Stamp} stamp @param {number} x pixel of its middle @param {number} y @param {number} color as 0xbbggrr */
    function put(stamp, x, y, color) {
        const { words, width, height } = own, { dx, dy, offset, cover, reach } = stamp, n = cover.length, middle = y * width + x;
        if (x < -reach || y < -reach || x >= width + reach || y >= height + reach) return;
        if (x - reach < box.left) box.left = x - reach;
        if (y - reach < box.top) box.top = y - reach;
        if (x + reach >= box.right) box.right = x + reach + 1;
        if (y + reach >= box.bottom) box.bottom = y + reach + 1;
        if (x >= reach && y >= reach && x + reach < width && y + reach < height) {
            for (let i = 0; i < n; i++) {
                const at = middle + offset[i], part = cover[i];
                if (part > words[at] >>> 24) words[at] = part << 24 | color;
            }
            return;
        }
        for (let i = 0; i < n; i++) {
            const at = middle + offset[i], part = cover[i];
            if (part <= words[at] >>> 24) continue;
            if (x + dx[i] >= 0 && x + dx[i] < width && y + dy[i] >= 0 && y + dy[i] < height) words[at] = part << 24 | color;
        }
    }

    /** Makes the picture as large as a map; it is clear. */
    function begin() {
        const ratio = window.devicePixelRatio || 1, width = Math.round(camera.now.width * ratio), height = Math.round(camera.now.height * ratio);
        if (own.width !== width || own.ratio !== ratio) {
            own.shapes.clear();
            own.size = 0;
        }
        own.ratio = ratio;
        if (!own.image || own.width !== width || own.height !== height) {
            own.canvas = own.canvas ?? document.createElement("canvas");
            [own.canvas.width, own.canvas.height] = [own.width, own.height] = [width, height];
            own.image = new ImageData(width, height);
            own.words = new Int32Array(own.image.data.buffer);
            Object.assign(last, { left: 0, top: 0, right: 0, bottom: 0 });
        } else {
            own.words.fill(0, Math.max(0, last.top) * width, Math.max(0, last.bottom) * width);
        }
        Object.assign(box, { left: width, top: height, right: 0, bottom: 0 });
    }

    /** Draws the picture on the canvas. @param {CanvasRenderingContext2D} c */
    function paint(c) {
        if (box.right === 0 || !own.canvas || !own.image) return;
        const left = Math.min(box.left, last.left), top = Math.min(box.top, last.top), right = Math.max(box.right, last.right), bottom = Math.max(box.bottom, last.bottom);
        const own_context = /** @type {CanvasRenderingContext2D} */ (own.canvas.getContext("2d", { willReadFrequently: true }));
        own_context.putImageData(own.image, 0, 0, left, top, right - left, bottom - top);
        Object.assign(last, box);
        c.drawImage(own.canvas, 0, 0, camera.now.width, camera.now.height);
    }

    /** Colour of `#rrggbb` as 0xbbggrr. @param {string} color */
    function word(color) {
        const [red = 0, green = 0, blue = 0] = theme.channels(color);
        return red | green << 8 | blue << 16;
    }

    /** Squares around places. @param {Float64Array} xs [px] @param {Float64Array} ys @param {(i: number) => boolean} wanted @param {number} size @param {number} color */
    function squares(xs, ys, wanted, size, color) {
        const { ratio } = own;
        if (size * ratio !== own.size) [own.size, own.squares] = [size * ratio, squares_of(size * ratio)];
        for (let i = 0; i < xs.length; i++) {
            if (!wanted(i)) continue;
            const x = xs[i] * ratio, y = ys[i] * ratio, left = Math.floor(x), top = Math.floor(y);
            put(own.squares[Math.floor((y - top) * parts) * parts + Math.floor((x - left) * parts)], left, top, color);
        }
    }

    /** Ring around a place; false if it is too large. @param {number} x [px] @param {number} y @param {number} radius @param {number} color */
    function ring(x, y, radius, color) {
        if (radius > largest_ring) return false;
        const { ratio } = own, size = Math.round(2 * radius * ratio) / 2;
        let stamp = own.shapes.get(size);
        if (!stamp) own.shapes.set(size, stamp = ring_of(size, 1.2 * ratio));
        put(stamp, Math.floor(x * ratio), Math.floor(y * ratio), color);
        return true;
    }

    /** Sign of what became of a frame. @param {number} sign @param {number} r half its size [px] @param {number} strength of 1 */
    function mark_of(sign, r, strength) {
        const reach = Math.ceil((r + 2) * own.ratio), side = 2 * reach + 1, canvas = document.createElement("canvas");
        canvas.width = canvas.height = side;
        const c = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
        c.scale(own.ratio, own.ratio);
        signs.outline(c, sign, side / 2 / own.ratio, side / 2 / own.ratio, r);
        c.lineWidth = 1.2;
        c.stroke();
        const { data } = c.getImageData(0, 0, side, side);
        return stamp_of(reach, (x, y) => strength * data[4 * ((y + reach) * side + x + reach) + 3] / 255);
    }

    /** Signs around places. @param {number[]} ends x and y of each [px] @param {number} sign @param {number} r half their size @param {number} strength of 1 @param {number} color */
    function marks(ends, sign, r, strength, color) {
        const { ratio } = own, key = -1 - sign - signs.count * Math.round(100 * strength);
        let stamp = own.shapes.get(key);
        if (!stamp) own.shapes.set(key, stamp = mark_of(sign, r, strength));
        for (let i = 0; i < ends.length; i += 2) put(stamp, Math.floor((ends[i] + 9) * ratio), Math.floor((ends[i + 1] - 9) * ratio), color);
    }

    return { begin, squares, ring, marks, paint, word };
})();
