// SPDX-License-Identifier: MIT
// Lines and texts on a canvas.
const pen = (() => {
    "use strict";
    const rim = 1.25;  // [px] of paper around lines that lie on others
    /** Boxes that texts do not cover: left, top, right, bottom [px]. @type {number[][]} */ let taken = [];

    /** @param {number} size [px] */
    function font(size) { return `${size}px "DejaVu Sans",Verdana,sans-serif`; }

    /** The next lines have this look. @param {CanvasRenderingContext2D} c @param {string} color @param {number} width @param {number[]} [dash] */
    function take(c, color, width, dash = []) {
        c.strokeStyle = color;
        c.lineWidth = width;
        c.setLineDash(dash);
    }

    /** Line through points, x and y of each. @param {CanvasRenderingContext2D} c @param {number[]} points */
    function line(c, ...points) {
        c.beginPath();
        for (let i = 0; i < points.length; i += 2) c.lineTo(points[i], points[i + 1]);
        c.stroke();
    }

    /** Path of a circle. @param {CanvasRenderingContext2D} c @param {number} x @param {number} y @param {number} r */
    function circle(c, x, y, r) {
        c.beginPath();
        c.arc(x, y, r, 0, 2 * Math.PI);
    }

    /** Strokes a path between rims of paper. @param {CanvasRenderingContext2D} c @param {string} color @param {number} width @param {Path2D} [path] that of the canvas without it */
    function rimmed(c, color, width, path) {
        for (const [style, wide] of /** @type {[string, number][]} */ ([[theme.colors().paper, width + 2 * rim], [color, width]])) {
            take(c, style, wide);
            if (path) c.stroke(path); else c.stroke();
        }
    }

    /** Texts begin anew. @param {number[][]} boxes that they do not cover */
    function clear(boxes) { taken = boxes; }

    /** Writes a text where it is in sight and covers no other, else not at all. @param {CanvasRenderingContext2D} c @param {string} text @param {number} size @param {string} color @param {(width: number) => number[][]} places for it, the best first: left end and middle [px] */
    function label(c, text, size, color, places) {
        c.font = font(size);
        c.textBaseline = "middle";
        c.lineJoin = "round";
        const { width } = c.measureText(text), half = size / 2 + 1, map = camera.now;
        for (const [x, y] of places(width)) {
            const [top, right, bottom] = [y - half, x + width, y + half];
            if (x < 0 || top < 0 || right > map.width || bottom > map.height || taken.some(b => x < b[2] && right > b[0] && top < b[3] && bottom > b[1])) continue;
            taken.push([x, top, right, bottom]);
            take(c, theme.colors().paper, 6);
            c.strokeText(text, x, y);
            c.fillStyle = color;
            c.fillText(text, x, y);
            return;
        }
    }

    return { font, take, line, circle, rimmed, clear, label };
})();
