// The harvester to scale: the drawing of `jounce show`, whose stop, gap and patch ends can be dragged.

import type { Controls } from "./controls";
import type { Design } from "./design";

/** Left and upper edge, width, height on the sheet. */
type Box = [number, number, number, number];

interface Grip {
    kind: "start" | "end" | "place" | "gap";
    name: string;
    /** The key that the grip moves; a start moves the length of its patch too, so that the far end stays. */
    key: string;
    length?: string;
    at: [number, number];
    px_per_m: [number, number];
}

interface Drawn {
    svg: string;
    side: Box;
    cells: Box[];
    grips: Grip[];
}

type Move = (metres: number, moving: boolean) => void;

const SVG = "http://www.w3.org/2000/svg";
/** Free edge around what is shown of the sheet. */
const EDGE = 8;
/** Width and height of what can be caught, drawing units. */
const CATCH = { start: [14, 44], end: [14, 44], place: [20, 26], gap: [60, 40] };
/** The same for a gap in the side view, where the place of the stop is near. */
const CATCH_BESIDE = [40, 12];
const WORDS = { start: "Start of patch", end: "End of patch", place: "Place of stop", gap: "Gap of stop" };
/** Step of an arrow key, drawing units. */
const STEP = 2;

export class Drawing {
    svg = "";
    private held: { move: Move; x: number; y: number; metres: [number, number] } | undefined;

    constructor(private readonly side: HTMLElement, private readonly close: HTMLElement, private readonly controls: Controls, private readonly design: Design) {
        addEventListener("pointermove", (event) => this.drag(event, true));
        addEventListener("pointerup", (event) => {
            this.drag(event, false);
            this.held = undefined;
        });
    }

    take(drawn: Drawn): void {
        this.svg = drawn.svg;
        const focused = document.activeElement?.getAttribute("data-handle");
        const whole = new DOMParser().parseFromString(drawn.svg, "image/svg+xml").documentElement;
        const sheets = [drawn.side, ...drawn.cells].map((box) => sheet(whole, box));
        sheets[0].view.setAttribute("aria-label", "Side view to scale");
        sheets.slice(1).forEach(({ view }) => view.setAttribute("aria-label", "Circuit or closer look"));
        for (const grip of drawn.grips) {
            const inside = sheets.find((_, k) => holds([drawn.side, ...drawn.cells][k], grip.at)) ?? sheets[0];
            this.offer(inside.page, grip, inside === sheets[0]);
        }
        this.side.replaceChildren(sheets[0].view);
        this.close.replaceChildren(...sheets.slice(1).map(({ view }) => view));
        this.close.hidden = drawn.cells.length === 0;
        if (focused) document.querySelector<SVGElement>(`[data-handle="${focused}"]`)?.focus();
    }

    /** Gives a grip its handle, where its key has a control. */
    private offer(page: SVGSVGElement, grip: Grip, beside: boolean): void {
        const { kind, key } = grip;
        const value = this.controls.find(key)?.value;
        const length = grip.length === undefined ? undefined : this.controls.find(grip.length)?.value;
        const words = (name: string, si: number): [string, string] => [name, this.controls.words(name, si)];
        const set = (si: number, moving: boolean) => this.design.setAll([words(key, si)], moving);
        if (value === undefined) return;
        const moves: Record<Grip["kind"], Move | undefined> = {
            start: length === undefined ? undefined : (metres, moving) => {
                const moved = Math.min(Math.max(metres, -value), 0.98 * length);
                this.design.setAll([words(key, value + moved), words(grip.length!, length - moved)], moving);
            },
            end: (metres, moving) => set(Math.max(0.02 * value, value + metres), moving),
            place: (metres, moving) => set(Math.max(0, value + metres), moving),
            gap: value > 0 ? (metres, moving) => set(Math.max(0.01 * value, value + metres), moving) : undefined,
        };
        const move = moves[kind];
        if (move) this.handle(page, grip, kind === "gap" && beside ? CATCH_BESIDE : CATCH[kind], value, move);
    }

    private handle(page: SVGSVGElement, grip: Grip, [width, height]: number[], value: number, move: Move): void {
        const group = document.createElementNS(SVG, "g");
        const area = document.createElementNS(SVG, "rect");
        const vertical = grip.kind === "gap";
        for (const [name, number] of Object.entries({ x: grip.at[0] - width / 2, y: grip.at[1] - height / 2, width, height, rx: 4 })) {
            area.setAttribute(name, String(number));
        }
        const words = `${WORDS[grip.kind]} ${grip.name}`;
        const said = {
            class: `handle ${vertical ? "vertical" : "horizontal"}`, "data-handle": grip.key, tabindex: "0", role: "slider", "aria-label": words,
            "aria-orientation": vertical ? "vertical" : "horizontal", "aria-valuenow": String(value),
            "aria-valuetext": this.controls.words(grip.key, value),
        };
        for (const [name, text] of Object.entries(said)) group.setAttribute(name, text);
        const tip = document.createElementNS(SVG, "title");
        tip.textContent = `${words}: drag, or use the arrow keys`;
        group.append(tip, area);
        // Metres for a drawing unit in each direction.
        const [x, y] = grip.px_per_m;
        const metres: [number, number] = [x / (x * x + y * y), y / (x * x + y * y)];
        group.addEventListener("pointerdown", (event) => {
            const scale = page.getScreenCTM()?.a ?? 1;
            this.held = { move, x: event.clientX, y: event.clientY, metres: [metres[0] / scale, metres[1] / scale] };
            group.focus();
            event.preventDefault();
        });
        group.addEventListener("keydown", (event) => {
            const step = ({ ArrowRight: [STEP, 0], ArrowLeft: [-STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] } as Record<string, [number, number]>)[event.key];
            if (!step) return;
            event.preventDefault();
            move(step[0] * metres[0] + step[1] * metres[1], false);
        });
        page.append(group);
    }

    private drag(event: PointerEvent, moving: boolean): void {
        if (!this.held) return;
        const { move, x, y, metres } = this.held;
        move((event.clientX - x) * metres[0] + (event.clientY - y) * metres[1], moving);
    }
}

/** A part of the sheet by itself: `page` has the coordinates of the sheet. */
function sheet(whole: Element, [left, top, wide, high]: Box): { view: SVGSVGElement; page: SVGSVGElement } {
    const view = document.createElementNS(SVG, "svg");
    const page = document.importNode(whole, true) as unknown as SVGSVGElement;
    const [x, y, width, height] = [left - EDGE, top - EDGE, wide + 2 * EDGE, high + 2 * EDGE];
    view.setAttribute("viewBox", `0 0 ${width} ${height}`);
    view.setAttribute("role", "group");
    for (const [name, value] of Object.entries({ x: 0, y: 0, width, height, viewBox: `${x} ${y} ${width} ${height}`, overflow: "hidden" })) {
        page.setAttribute(name, String(value));
    }
    page.removeAttribute("role");
    // What begins elsewhere on the sheet is not seen here, and must not be read either.
    for (const part of [...page.children]) {
        const place = beginning(part);
        if (!place || !holds([x, y, width, height], place)) part.remove();
    }
    view.append(page);
    return { view, page };
}

/** Where an element begins on the sheet; nothing for the title and the paper. */
function beginning(part: Element): [number, number] | undefined {
    const words = part.getAttribute("d")?.match(/-?[\d.]+/g) ?? [part.getAttribute("x"), part.getAttribute("y")];
    return words[0] === null || part.classList.contains("jounce-paper") && !part.hasAttribute("stroke") ? undefined : [Number(words[0]), Number(words[1])];
}

function holds([left, top, wide, high]: Box, [x, y]: [number, number]): boolean {
    return x >= left && x <= left + wide && y >= top && y <= top + high;
}
