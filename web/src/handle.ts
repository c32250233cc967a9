// Handles of the drawing, moved with the mouse or with the arrow keys.

export interface Grip {
    kind: "start" | "end" | "place" | "gap";
    name: string;
    /** Key that the grip moves; a start also changes the length of its patch, so that the far end is fixed. */
    key: string;
    length?: string;
    at: [number, number];
    px_per_m: [number, number];
}

/** Moves a grip by metres from its initial position. */
export type Move = (metres: number, moving: boolean) => void;

/** Held grip, its initial position, and the metres of a pixel in each direction. */
export interface Held {
    move: Move;
    x: number;
    y: number;
    metres: [number, number];
}

interface Shown {
    words: string;
    value: number;
    move: Move;
}

const SVG = "http://www.w3.org/2000/svg";
const WORDS = { start: "Start of patch", end: "End of patch", place: "Position of stop", gap: "Gap of stop" };
/** Step of an arrow key, drawing units. */
const STEP = 2;

export class Handle {
    private readonly group = document.createElementNS(SVG, "g");
    private readonly tip = document.createElementNS(SVG, "title");
    private readonly area = document.createElementNS(SVG, "rect");
    private move: Move = () => {};
    /** Metres of a drawing unit in each direction. */
    private metres: [number, number] = [0, 0];

    constructor(catches: (held: Held) => void) {
        this.group.append(this.tip, this.area);
        this.group.addEventListener("pointerdown", (event) => {
            const scale = this.group.getScreenCTM()?.a ?? 1;
            const [x, y] = this.metres;
            catches({ move: this.move, x: event.clientX, y: event.clientY, metres: [x / scale, y / scale] });
            this.group.focus();
            event.preventDefault();
        });
        this.group.addEventListener("keydown", (event) => {
            const step = ({ ArrowRight: [STEP, 0], ArrowLeft: [-STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] } as Record<string, [number, number]>)[event.key];
            if (!step) return;
            event.preventDefault();
            this.move(step[0] * this.metres[0] + step[1] * this.metres[1], false);
        });
    }

    /** Places the handle at the position of its grip on a page. */
    show(page: SVGSVGElement, grip: Grip, [width, height]: number[], { words, value, move }: Shown): void {
        const orientation = grip.kind === "gap" ? "vertical" : "horizontal";
        const name = `${WORDS[grip.kind]} ${grip.name}`;
        const said = {
            class: `handle ${orientation}`, "data-handle": grip.key, tabindex: "0", role: "slider", "aria-label": name,
            "aria-orientation": orientation, "aria-valuenow": String(value), "aria-valuetext": words,
        };
        for (const [attribute, text] of Object.entries(said)) this.group.setAttribute(attribute, text);
        const area = { x: grip.at[0] - width / 2, y: grip.at[1] - height / 2, width, height, rx: 4 };
        for (const [attribute, number] of Object.entries(area)) this.area.setAttribute(attribute, String(number));
        this.tip.textContent = `${name}: drag, or use the arrow keys`;
        const [x, y] = grip.px_per_m;
        this.metres = [x / (x * x + y * y), y / (x * x + y * y)];
        this.move = move;
        page.append(this.group);
    }
}
