// Pointing at the response: the point under the pointer, a click or a drag along a branch that selects a point, and the arrow keys.

import type { Place, ResponseResult } from "./branches";
import type { Chart } from "./chart";
import type { LineHandle } from "./line";
import { nearestPoint } from "./nearest";
import { Zoom } from "./zoom";

/** Largest distance of the pointer from a curve for a readout, and for a drag along it, CSS pixels. */
const REACH = 40;
const CATCH = 8;
/** Distance of the readout from the pointer, CSS pixels. */
const AWAY = 14;
/** Half the size of the ring around the point, with its line. */
const RING = 7;

/** The response, as far as it is pointed at. */
interface Pointed {
    readonly chart: Chart;
    readonly result: ResponseResult | undefined;
    readonly chosen: Place | undefined;
    /** Branches that are drawn, with the values on the vertical axis. */
    drawn(): { branch: number; x: ArrayLike<number>; y: ArrayLike<number>; gap: (from: number) => boolean }[];
    choose(place: Place): void;
    hover(place: Place | undefined): void;
}

export class Pointing {
    /** Number of the branch along which the pointer is dragged. */
    private held: number | undefined;
    private dragged = false;

    constructor(private readonly response: Pointed, line: LineHandle, private readonly readout: HTMLElement) {
        const { host } = response.chart;
        host.addEventListener("pointerdown", (event) => {
            this.dragged = false;
            const found = line.isHeld || event.button !== 0 ? undefined : this.at(event);
            this.held = found && found.away <= CATCH ? found.branch : undefined;
        });
        host.addEventListener("pointermove", (event) => this.move(event));
        for (const end of ["pointerup", "pointercancel"]) host.addEventListener(end, () => (this.held = undefined));
        host.addEventListener("pointerleave", () => response.hover(undefined));
        const zoom = new Zoom(response.chart, () => line.isHeld || this.held !== undefined);
        host.addEventListener("click", (event) => {
            const found = line.dragged || zoom.dragged || this.dragged ? undefined : this.at(event);
            if (found && found.away <= REACH) response.choose(found);
        });
        host.addEventListener("keydown", (event) => this.key(event));
    }

    private move(event: PointerEvent): void {
        const { response, held } = this;
        const found = this.at(event, held);
        if (held === undefined) {
            if (found && found.away <= CATCH && response.chart.host.style.cursor === "") response.chart.host.style.cursor = "pointer";
            const near = found && found.away <= REACH ? found : undefined;
            response.hover(near);
            return this.placeReadout(event, near);
        }
        if (!found) return;
        if (!this.dragged) response.chart.host.setPointerCapture(event.pointerId);
        this.dragged = true;
        response.hover(found);
        this.placeReadout(event, found);
        const { chosen } = response;
        if (found.branch !== chosen?.branch || found.point !== chosen.point) response.choose({ branch: found.branch, point: found.point });
    }

    /** Places the readout next to the pointer, inside the chart, away from the point that it describes. */
    private placeReadout({ clientX, clientY }: MouseEvent, place: Place | undefined): void {
        const { host } = this.response.chart;
        const [box, own] = [host.getBoundingClientRect(), this.readout.getBoundingClientRect()];
        const pointer: [number, number] = [clientX - box.left, clientY - box.top];
        const avoided = [pointer, ...(place ? [this.positionOf(place)] : [])];
        const inside = (at: number, room: number) => Math.max(0, Math.min(at, room));
        const sides = (at: number, size: number, room: number) => {
            const both = [at + AWAY, at - AWAY - size].map((start) => inside(start, room - size));
            return at < 0.5 * room ? both : both.reverse();
        };
        const free = avoided.flatMap(([x, y]) => sides(y, own.height, box.height).flatMap((top) => sides(x, own.width, box.width).map((left): [number, number] => [left, top])));
        const covers = ([left, top]: [number, number]) => avoided.some(([x, y]) => x > left - RING && x < left + own.width + RING && y > top - RING && y < top + own.height + RING);
        const [left, top] = free.find((at) => !covers(at)) ?? free[0];
        this.readout.style.left = `${left}px`;
        this.readout.style.top = `${top}px`;
    }

    /** Position of a point on the chart, CSS pixels. */
    private positionOf({ branch, point }: Place): [number, number] {
        const { chart } = this.response;
        const [drawn, over] = [this.response.drawn().find((own) => own.branch === branch)!, chart.over!.getBoundingClientRect()];
        const [x, y] = chart.place(drawn.x[point], drawn.y[point]);
        const box = chart.host.getBoundingClientRect();
        return [x + over.left - box.left, y + over.top - box.top];
    }

    /** Point nearest to the pointer, of one branch if it is given. */
    private at(event: MouseEvent, branch?: number): (Place & { away: number }) | undefined {
        const { chart } = this.response;
        const box = chart.over?.getBoundingClientRect();
        if (!box) return undefined;
        const curves = this.response.drawn().filter((own) => branch === undefined || own.branch === branch);
        const found = nearestPoint(
            [event.clientX - box.left, event.clientY - box.top],
            curves.map(({ x, y, gap }) => ({ count: x.length, place: (point) => chart.place(x[point], y[point]), gap })),
        );
        return found && { branch: curves[found.curve].branch, point: found.point, away: found.away };
    }

    private key(event: KeyboardEvent): void {
        const branches = this.response.result?.branches ?? [];
        const chosen = this.response.chosen ?? { branch: 0, point: 0 };
        const step = { ArrowRight: 1, ArrowLeft: -1, PageUp: 10, PageDown: -10 }[event.key];
        if (branches.length === 0 || event.shiftKey) return;
        let { branch, point } = chosen;
        if (event.key === "Home") point = 0;
        else if (event.key === "End") point = branches[branch].x.length - 1;
        else if (step !== undefined) point = Math.min(Math.max(point + step, 0), branches[branch].x.length - 1);
        else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
            const shown = new Set(this.response.drawn().map((own) => own.branch));
            const step = event.key === "ArrowUp" ? 1 : branches.length - 1;
            do branch = (branch + step) % branches.length;
            while (!shown.has(branch) && branch !== chosen.branch);
            point = Math.min(point, branches[branch].x.length - 1);
        } else return;
        event.preventDefault();
        this.response.choose({ branch, point });
    }
}
