// SPDX-License-Identifier: MIT
// Picture of pixels for thousands of small shapes: a path of so many takes the browser ten times as long.
/** Pixels that a shape covers: where they are from its middle, and how much of each, of 255. @typedef {{offset: Int32Array, cover: Uint8Array, reach: number}} Stamp */
const pixels = (() => {
    "use strict";
    const parts = 4;          // of a pixel, at which squares begin
    const largest_ring = 60;  // [px], radius
    const ring_alpha = 0.6;
    /** @type {{canvas: HTMLCanvasElement|null, image: ImageData|null, words: Int32Array, width: number, height: number, size: number, covers: Uint8Array[], shapes: Map<number, Stamp>, ratio: number, margin: number}} */
    const own = { canvas: null, image: null, words: new Int32Array(0), width: 0, height: 0, size: 0, covers: [], shapes: new Map(), ratio: 1, margin: 0 };
    // Words have a margin around the map, so that shapes at its rim need no clipping.
    /** Rows and columns that are not clear: in the words now, and when they were painted last. */
    const box = { left: 0, top: 0, right: 0, bottom: 0 }, last = { ...box };

    /** Squares as they were drawn last. They are drawn again when one has moved by a part of a pixel. */
    const nowhere = new Float64Array(0);
    const crowd = { words: new Int32Array(0), xs: nowhere, ys: nowhere, colors: new Int32Array(0), box: { ...box } };

    /** @param {number} reach @param {(dx: number, dy: number) => number} share of a pixel that is covered @returns {Stamp} */
    function stamp_of(reach, share) {
        /** @type {number[]} */ const offset = [];
        /** @type {number[]} */ const cover = [];
        for (let y = -reach; y <= reach; y++) {
            for (let x = -reach; x <= reach; x++) {
                const part = Math.round(255 * Math.min(1, share(x, y)));
                if (part > 0) offset.push(y * own.width + x), cover.push(part);
            }
        }
        return { offset: Int32Array.from(offset), cover: Uint8Array.from(cover), reach };
    }

    /** Covers of a square's pixels, row by row, for each part of a pixel at which it may begin. @param {number} size [px] */
    function covers_of(size) {
        const side = side_of(size);
        /** @param {number} begin @param {number} pixel */
        const covered = (begin, pixel) => Math.max(0, Math.min(pixel + 1, begin + size) - Math.max(pixel, begin));
        return Array.from({ length: parts * parts }, (_, i) => Uint8Array.from({ length: side * side }, (_, k) =>
            Math.round(255 * covered((i % parts + 0.5) / parts, k % side) * covered((Math.floor(i / parts) + 0.5) / parts, Math.floor(k / side)))));
    }

    /** @param {number} size [px] */
    function side_of(size) { return Math.ceil(size) + 1; }

    /** @param {number} radius [px] in halves @param {number} width [px] */
    function ring_of(radius, width) {
        return stamp_of(Math.ceil(radius + width), (x, y) => ring_alpha * Math.max(0, width / 2 + 0.5 - Math.abs(Math.hypot(x + 0.5, y + 0.5) - radius)));
    }

    /** Makes a part of the picture known as drawn on. @param {number} left @param {number} top @param {number} right @param {number} bottom */
    function touch(left, top, right, bottom) {
        if (left < box.left) box.left = left;
        if (top < box.top) box.top = top;
        if (right > box.right) box.right = right;
        if (bottom > box.bottom) box.bottom = bottom;
    }

    /** False if the shape is not within the margin. @param {Stamp} stamp @param {number} px place of its middle on the map [px] @param {number} py @param {number} color as 0xbbggrr */
    function put({ offset, cover, reach }, px, py, color) {
        const { words, width, height, ratio, margin } = own, x = Math.floor(px * ratio) + margin, y = Math.floor(py * ratio) + margin;
        if (x < reach || y < reach || x + reach >= width || y + reach >= height) return false;
        touch(x - reach, y - reach, x + reach + 1, y + reach + 1);
        for (let i = 0, middle = y * width + x; i < cover.length; i++) {
            const at = middle + offset[i], part = cover[i];
            if (part > words[at] >>> 24) words[at] = part << 24 | color;
        }
        return true;
    }

    /** Makes the picture as large as a map. `clear` or `squares` follows. */
    function begin() {
        const ratio = window.devicePixelRatio || 1, margin = Math.ceil((largest_ring + 3) * ratio);
        const inner = { width: Math.round(camera.now.width * ratio), height: Math.round(camera.now.height * ratio) };
        const width = inner.width + 2 * margin, height = inner.height + 2 * margin;
        Object.assign(box, { left: width, top: height, right: 0, bottom: 0 });
        if (!own.image || own.width !== width || own.height !== height || own.ratio !== ratio) {
            const canvas = Object.assign(own.canvas ?? document.createElement("canvas"), inner), image = new ImageData(width, height);
            own.shapes.clear();
            Object.assign(own, { canvas, image, words: new Int32Array(image.data.buffer), width, height, ratio, margin, size: 0 });
            Object.assign(last, box);
        }
    }

    /** Clears the picture; the squares are no longer there. */
    function clear() {
        own.words.fill(0, last.top * own.width, last.bottom * own.width);
        crowd.xs = nowhere;
    }

    /** Draws the picture on the canvas. @param {CanvasRenderingContext2D} c */
    function paint(c) {
        if (box.right === 0 || !own.canvas || !own.image) return;
        const own_context = /** @type {CanvasRenderingContext2D} */ (own.canvas.getContext("2d", { willReadFrequently: true }));
        const left = Math.min(box.left, last.left), top = Math.min(box.top, last.top);
        own_context.putImageData(own.image, -own.margin, -own.margin, left, top, Math.max(box.right, last.right) - left, Math.max(box.bottom, last.bottom) - top);
        Object.assign(last, box);
        c.drawImage(own.canvas, 0, 0, camera.now.width, camera.now.height);
    }

    /** Colour of `#rrggbb` as 0xbbggrr. @param {string} color */
    function word(color) {
        const [red, green, blue] = theme.channels(color);
        return red | green << 8 | blue << 16;
    }

    /** Whether the squares that were drawn last are those, but for a part of a pixel. @param {Float64Array} xs [px] @param {Float64Array} ys @param {Int32Array} colors */
    function stands(xs, ys, colors) {
        const slack = 1 / parts / own.ratio;
        if (crowd.xs.length !== xs.length) return false;
        for (let i = 0; i < xs.length; i++) {
            if (crowd.colors[i] !== colors[i] || Math.abs(crowd.xs[i] - xs[i]) > slack || Math.abs(crowd.ys[i] - ys[i]) > slack) return false;
        }
        return true;
    }

    /** Squares around places, and nothing else. @param {Float64Array} xs [px] @param {Float64Array} ys @param {Int32Array} colors below 0: none @param {number} size */
    function squares(xs, ys, colors, size) {
        const { words, width } = own, pixel_size = size * own.ratio;
        if (pixel_size === own.size && stands(xs, ys, colors)) {
            words.set(crowd.words.subarray(last.top * width, last.bottom * width), last.top * width);
            Object.assign(box, crowd.box);
            return;
        }
        if (pixel_size !== own.size) [own.size, own.covers] = [pixel_size, covers_of(pixel_size)];
        clear();
        put_squares(xs, ys, colors);
        if (crowd.words.length !== words.length) crowd.words = new Int32Array(words.length);
        crowd.words.set(words);
        Object.assign(crowd, { xs: xs.slice(), ys: ys.slice(), colors: colors.slice(), box: { ...box } });
    }

    /** Draws squares row by row. @param {Float64Array} xs [px] @param {Float64Array} ys @param {Int32Array} colors */
    function put_squares(xs, ys, colors) {
        const { words, width, height, ratio, margin, covers, size } = own, side = side_of(size), shift = margin - size / 2;
        for (let i = 0; i < xs.length; i++) {
            const color = colors[i], x = xs[i] * ratio + shift, y = ys[i] * ratio + shift;
            if (color < 0 || !(x >= 0 && y >= 0 && x < width - side && y < height - side)) continue;
            const column = x | 0, row = y | 0, cover = covers[((y - row) * parts | 0) * parts + ((x - column) * parts | 0)];
            touch(column, row, column + side, row + side);
            let at = row * width + column;
            for (let k = 0; k < cover.length; at += width - side) {
                for (const end = k + side; k < end; k++, at++) {
                    if (cover[k] > words[at] >>> 24) words[at] = cover[k] << 24 | color;
                }
            }
        }
    }

    /** Ring around a place; false if it is too large, or far beyond the rim. @param {number} x [px] @param {number} y @param {number} radius @param {number} color */
    function ring(x, y, radius, color) {
        if (radius > largest_ring) return false;
        const { ratio } = own, size = Math.round(2 * radius * ratio) / 2;
        let stamp = own.shapes.get(size);
        if (!stamp) own.shapes.set(size, stamp = ring_of(size, 1.2 * ratio));
        return put(stamp, x, y, color);
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
        const key = -1 - sign - signs.count * Math.round(100 * strength);
        let stamp = own.shapes.get(key);
        if (!stamp) own.shapes.set(key, stamp = mark_of(sign, r, strength));
        for (let i = 0; i < ends.length; i += 2) put(stamp, ends[i] + 9, ends[i + 1] - 9, color);
    }

    return { begin, clear, squares, ring, marks, paint, word };
})();
