// Zoom and pan of a chart: wheel, drag, double-click, and the keys + - 0 and Shift with the arrows.

import type { Chart } from "./chart";

/** Change of the visible width by one step of the wheel or one key. */
const STEP = 0.8;
/** Share of the visible range that an arrow key moves. */
const KEY_SHARE = 0.1;
/** Movement after which a press is a drag, CSS pixels. */
const DRAG = 4;

export class Zoom {
    /** True from the first movement of a drag until the click that ends it. */
    dragged = false;
    private from: [number, number] | undefined;

    /** `taken` is true while something else on the chart is dragged. */
    constructor(private readonly chart: Chart, private readonly taken: () => boolean = () => false) {
        const { host } = chart;
        host.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
        host.addEventListener("dblclick", () => chart.unzoom());
        host.addEventListener("pointerdown", (event) => {
            this.dragged = false;
            this.from = this.taken() || event.button !== 0 ? undefined : [event.clientX, event.clientY];
        });
        host.addEventListener("pointermove", (event) => this.drag(event));
        for (const end of ["pointerup", "pointercancel"]) host.addEventListener(end, () => (this.from = undefined));
        host.addEventListener("keydown", (event) => this.key(event));
    }

    private wheel(event: WheelEvent): void {
        const box = this.chart.over?.getBoundingClientRect();
        // Where the page itself scrolls, the wheel zooms with Ctrl only.
        if (!box || (!event.ctrlKey && document.documentElement.scrollHeight > innerHeight)) return;
        event.preventDefault();
        const share = (at: number) => Math.min(Math.max(at, 0), 1);
        this.chart.zoom([share((event.clientX - box.left) / box.width), share((box.bottom - event.clientY) / box.height)], event.deltaY < 0 ? STEP : 1 / STEP);
    }

    private drag(event: PointerEvent): void {
        const box = this.chart.over?.getBoundingClientRect();
        if (!this.from || !box || !this.chart.isZoomed) return;
        const [x, y] = [event.clientX - this.from[0], event.clientY - this.from[1]];
        if (!this.dragged && Math.hypot(x, y) < DRAG) return;
        if (!this.dragged) this.chart.host.setPointerCapture(event.pointerId);
        this.dragged = true;
        this.from = [event.clientX, event.clientY];
        this.chart.pan([-x / box.width, y / box.height]);
    }

    private key(event: KeyboardEvent): void {
        const arrow = ({ ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, [number, number]>)[event.key];
        if (arrow && event.shiftKey) this.chart.pan([KEY_SHARE * arrow[0], KEY_SHARE * arrow[1]]);
        else if (event.key === "+" || event.key === "=") this.chart.zoom([0.5, 0.5], STEP);
        else if (event.key === "-") this.chart.zoom([0.5, 0.5], 1 / STEP);
        else if (event.key === "0") this.chart.unzoom();
        else return;
        event.preventDefault();
    }
}
