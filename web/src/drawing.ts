// The harvester to scale: the drawing of `jounce show`, whose stop, gap and patch ends can be dragged.

import type { Controls } from "./controls";
import type { Design } from "./design";
import { type Grip, Handle, type Held, type Move } from "./handle";
import { raised } from "./units";

/** Left and upper edge, width, height on the sheet. */
type Box = [number, number, number, number];

interface Drawn {
    svg: string;
    side: Box;
    cells: Box[];
    /** Plan views of plates. */
    plans: Box[];
    grips: Grip[];
}

const SVG = "http://www.w3.org/2000/svg";
/** Margin around the visible part of the sheet. */
const EDGE = 8;
/** Width and height of the area of a handle, drawing units. */
const CATCH = { start: [14, 44], end: [14, 44], place: [20, 26], gap: [60, 40] };
/** Smallest scale of a part of the sheet: its letters of 12 px have 10 px. */
const MIN_SCALE = 10 / 12;
/** Distance of circuits and close-ups, px. */
const CELL_GAP = 4;
/** Time without a change of the room after which the sheet is drawn again. */
const REST_MS = 150;
/** Size for a gap in the side view, where the handle of the stop's position is near. */
const CATCH_BESIDE = [40, 12];

export class Drawing {
    svg = "";
    /** Called when the room for the drawing has changed. */
    onRoom: () => void = () => {};
    private held: Held | undefined;
    private requestedRoom = "";
    private rest: number | undefined;
    private handles = new Map<string, Handle>();

    constructor(private readonly side: HTMLElement, private readonly close: HTMLElement, private readonly controls: Controls, private readonly design: Design) {
        addEventListener("pointermove", (event) => this.drag(event, true));
        addEventListener("pointerup", (event) => {
            this.drag(event, false);
            this.held = undefined;
        });
        new ResizeObserver(() => {
            clearTimeout(this.rest);
            this.rest = setTimeout(() => this.checkRoom(), REST_MS);
        }).observe(side);
    }

    /** Room for each view, px, to request a sheet for it. On a page in one column the height is free. */
    requestRoom(): object {
        const room = this.room;
        this.requestedRoom = JSON.stringify(room);
        return room;
    }

    private get room(): { width: number; height?: number } {
        const { clientWidth, childElementCount } = this.side;
        const height = parseFloat(getComputedStyle(this.side).minHeight);
        return height > 0 ? { width: Math.floor(clientWidth / Math.max(childElementCount, 1)), height } : { width: clientWidth };
    }

    /** Circuits, close-ups and plan views, which come with the sheet, also change the room. */
    private checkRoom(): void {
        if (this.requestedRoom !== "" && JSON.stringify(this.room) !== this.requestedRoom) this.onRoom();
    }

    take(drawn: Drawn): void {
        this.svg = drawn.svg;
        const focused = document.activeElement;
        const before = this.handles;
        this.handles = new Map();
        const whole = new DOMParser().parseFromString(drawn.svg, "image/svg+xml").documentElement;
        for (const text of whole.querySelectorAll("text")) text.textContent = raised(text.textContent!);
        const boxes = [drawn.side, ...drawn.cells, ...drawn.plans];
        const sheets = boxes.map((box) => sheet(whole, box));
        const plans = sheets.slice(1 + drawn.cells.length);
        sheets[0].view.setAttribute("aria-label", "Side view to scale");
        sheets.slice(1).forEach(({ view }) => view.setAttribute("aria-label", "Circuit or close-up"));
        plans.forEach(({ view }) => {
            view.setAttribute("aria-label", "Plan view of a plate, to scale");
            view.classList.add("plan");
        });
        for (const grip of drawn.grips) {
            const inside = sheets.find((_, k) => holds(boxes[k], grip.at)) ?? sheets[0];
            this.offer(inside.page, grip, inside === sheets[0], before);
        }
        this.side.replaceChildren(...[sheets[0], ...plans].map(({ view }) => view));
        this.takeCells(sheets.slice(1, 1 + drawn.cells.length).map(({ view }) => view));
        if (focused instanceof SVGElement && focused.isConnected) focused.focus();
        this.checkRoom();
    }

    /** Circuits and close-ups: in one row where there is room. */
    private takeCells(views: SVGSVGElement[]): void {
        this.close.replaceChildren(...views);
        this.close.hidden = views.length === 0;
        const row = views.reduce((sum, { style }) => sum + parseFloat(style.minWidth) + CELL_GAP, 0);
        this.close.style.setProperty("--row", `${row}px`);
        // A circuit that is wider than the page is complete, with smaller letters.
        for (const { style } of views) style.minWidth = `min(${style.minWidth}, 100%)`;
    }

    /** Creates the handle of a grip, if its key has a control. */
    private offer(page: SVGSVGElement, grip: Grip, beside: boolean, before: Map<string, Handle>): void {
        const { kind, key } = grip;
        const control = this.controls.find(key);
        const value = control?.value;
        const length = grip.length === undefined ? undefined : this.controls.find(grip.length)?.value;
        const words = (name: string, si: number): [string, string] => [name, this.controls.words(name, si)];
        const set = (si: number, moving: boolean) => this.design.setAll([words(key, si)], moving);
        if (!control || value === undefined) return;
        // Points and patches end with their beam.
        const inside = (si: number, low: number) => Math.min(Math.max(low, si), control.to);
        const moves: Record<Grip["kind"], Move | undefined> = {
            start: length === undefined ? undefined : (metres, moving) => {
                const moved = Math.min(Math.max(metres, -value), 0.98 * length);
                this.design.setAll([words(key, value + moved), words(grip.length!, length - moved)], moving);
            },
            end: (metres, moving) => set(inside(value + metres, 0.02 * value), moving),
            place: (metres, moving) => set(inside(value + metres, 0), moving),
            gap: value > 0 ? (metres, moving) => set(Math.max(0.01 * value, value + metres), moving) : undefined,
        };
        const move = moves[kind];
        if (!move) return;
        // A handle outlives its drawing: a held or focused handle remains so.
        const name = `${kind} ${key} ${beside}`;
        const handle = before.get(name) ?? new Handle((held) => (this.held = held));
        handle.show(page, grip, kind === "gap" && beside ? CATCH_BESIDE : CATCH[kind], { words: this.controls.words(key, value), value, move });
        this.handles.set(name, handle);
    }

    private drag(event: PointerEvent, moving: boolean): void {
        if (!this.held) return;
        const { move, x, y, metres } = this.held;
        move((event.clientX - x) * metres[0] + (event.clientY - y) * metres[1], moving);
    }
}

/** A single part of the sheet; `page` has the coordinates of the sheet. */
function sheet(whole: Element, [left, top, wide, high]: Box): { view: SVGSVGElement; page: SVGSVGElement } {
    const view = document.createElementNS(SVG, "svg");
    const page = document.importNode(whole, true) as unknown as SVGSVGElement;
    const [x, y, width, height] = [left - EDGE, top - EDGE, wide + 2 * EDGE, high + 2 * EDGE];
    view.setAttribute("viewBox", `0 0 ${width} ${height}`);
    [view.style.minWidth, view.style.minHeight] = [width, height].map((size) => `${MIN_SCALE * size}px`);
    view.setAttribute("role", "group");
    for (const [name, value] of Object.entries({ x: 0, y: 0, width, height, viewBox: `${x} ${y} ${width} ${height}`, overflow: "hidden" })) {
        page.setAttribute(name, String(value));
    }
    page.removeAttribute("role");
    // Elements of other parts are invisible here; they are removed for screen readers.
    for (const part of [...page.children]) {
        const place = beginning(part);
        if (!place || !holds([x, y, width, height], place)) part.remove();
    }
    view.append(page);
    return { view, page };
}

/** Start of an element on the sheet; undefined for the title and the paper. */
function beginning(part: Element): [number, number] | undefined {
    const words = part.getAttribute("d")?.match(/-?[\d.]+/g) ?? [part.getAttribute("x"), part.getAttribute("y")];
    return words[0] === null || part.classList.contains("jounce-paper") && !part.hasAttribute("stroke") ? undefined : [Number(words[0]), Number(words[1])];
}

function holds([left, top, wide, high]: Box, [x, y]: [number, number]): boolean {
    return x >= left && x <= left + wide && y >= top && y <= top + high;
}
