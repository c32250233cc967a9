// The panel of the orbit at the operating point: its orbit, or words and buttons in place of it.

import type { Axes } from "./axes";
import type { Basins } from "./basins";
import type { Design } from "./design";
import type { Frame } from "./frame";
import type { OperatingPoint } from "./operating";
import type { Orbit } from "./orbit";
import type { Requests } from "./requests";
import type { Response } from "./response";
import type { Selection } from "./selection";
import type { AttractorPlace, ShownOrbit } from "./shown-orbit";
import { quantity } from "./units";
import type { Wire } from "./wire";

interface Views {
    axes: Axes;
    basins: Basins;
    design: Design;
    orbit: Orbit;
    point: OperatingPoint;
    requests: Requests;
    response: Response;
    selection: Selection;
    shown: ShownOrbit;
    wire: Wire;
}

export class OperatingOrbit {
    /** Attractor without a period whose motion is shown or computed. */
    private stretchOf = "";
    private readonly back = document.getElementById("operating-show")!;
    private readonly extend = document.getElementById("orbit-extend")!;

    constructor(private readonly views: Views) {
        const { axes, response, selection, wire } = views;
        wire.on("aperiodic-motion", (frame) => this.takeStretch(frame));
        this.extend.onclick = () => response.at !== undefined && axes.include(response.at);
        this.back.onclick = () => {
            selection.followOperating();
            this.show();
        };
    }

    /** Shows the operating point of a changed design. */
    designChanged(): void {
        this.views.selection.followOperating();
        this.back.hidden = true;
    }

    /** Says at the operating point and at the basins what the orbit in the panel is. */
    tell(): void {
        const { basins, point, response, shown } = this.views;
        const { place } = point;
        const isOperating = place !== undefined && shown.among(place.attractors) === place.attractor;
        this.back.hidden = response.following || isOperating;
        this.extend.hidden = !response.following || !response.isOutside;
        if (response.isOutside) this.extend.textContent = `${this.at} is outside the shown range: extend it`;
        basins.tellOrbit();
    }

    /** Shows a stretch of the motion of the attractor that most starts reach, which has no period. */
    private showStretch(id: string): void {
        const place = { attractors: this.views.point.number, attractor: id };
        const isShown = this.stretchOf === JSON.stringify(place);
        if (isShown) return;
        this.clear(`Most starts end in ${id}, which has no periodic orbit; select a point of a branch for its orbit`);
        this.stretchOf = JSON.stringify(place);
        this.views.wire.ask("aperiodic-motion", place);
        this.wait(true);
    }

    private takeStretch(frame: Frame): void {
        this.wait(false);
        if (frame.head.stage === "done" && this.stretchOf !== "") this.views.orbit.takeStretch(frame);
    }

    private wait(waits: boolean): void {
        document.getElementById("orbit-charts")!.ariaBusy = String(waits);
    }

    /** Registers that the panel shows an orbit. */
    orbitTaken(): void {
        this.stretchOf = "";
        this.tell();
    }

    /** The lost connection has taken the request with it. */
    forget(): void {
        this.stretchOf = "";
        this.wait(false);
    }

    /** Shows words in place of the orbit. */
    clear(words: string): void {
        this.stretchOf = "";
        this.views.orbit.clear(words);
        this.views.shown.take();
        this.tell();
    }

    /** Requests the orbit of the operating point, or says why there is none; the orbit of a point that the user has selected remains. */
    show(): void {
        const { point, requests, response, shown } = this.views;
        const { place } = point;
        if (!response.following) requests.compareAgain(shown.of);
        else if (place) {
            if (shown.isOf(place)) this.tell();
            else this.request(place);
        } else if (point.attractor) this.showStretch(point.attractor.id);
        else if (response.isOld) return;
        else if (response.chosen) requests.orbit(response.orbitSource(response.chosen, response.at));
        else if (response.result) this.clear("Orbit: the operating point is being computed");
    }

    /** Requests the orbit of an attractor of the present design. */
    request(place: AttractorPlace): void {
        const { design, requests } = this.views;
        requests.orbit({ place, at: this.at, design: design.signature, over: "" });
    }

    /** Present value of the key of the response, or of the drive frequency before the first response, with its unit. */
    private get at(): string {
        const { at, result } = this.views.response;
        return result && at !== undefined ? quantity(at, result.unit, 5) : quantity(this.views.point.hertz, "Hz", 5);
    }
}
