// The panel of the orbit at the operating point: its orbit, or words and buttons in place of it.

import type { Axes } from "./axes";
import type { Basins } from "./basins";
import type { OperatingPoint } from "./operating";
import type { Orbit } from "./orbit";
import type { Requests } from "./requests";
import type { Response } from "./response";
import type { ShownOrbit } from "./shown-orbit";
import { quantity } from "./units";

interface Views {
    axes: Axes;
    basins: Basins;
    orbit: Orbit;
    point: OperatingPoint;
    requests: Requests;
    response: Response;
    shown: ShownOrbit;
}

export class OperatingOrbit {
    private readonly back = document.getElementById("operating-show")!;
    private readonly extend = document.getElementById("orbit-extend")!;

    constructor(private readonly views: Views) {
        const { axes, response } = views;
        this.extend.onclick = () => response.at !== undefined && axes.include(response.at);
        this.back.onclick = () => {
            response.follow(true);
            this.show();
        };
    }

    /** Shows the operating point of a changed design. */
    designChanged(): void {
        this.views.response.follow(true);
        this.back.hidden = true;
    }

    /** Says at the operating point and at the basins what the orbit in the panel is. */
    tell(): void {
        const { basins, point, response, shown } = this.views;
        const isOperating = point.attractor !== undefined && shown.among([point.attractor]) !== undefined;
        this.back.hidden = response.following || isOperating;
        this.extend.hidden = true;
        basins.tellOrbit();
    }

    /** Shows words in place of the orbit. */
    clear(words: string): void {
        this.views.orbit.clear(words);
        this.views.shown.take();
        this.tell();
    }

    /** Requests the orbit of the operating point, or says why there is none. */
    show(): void {
        const { point, requests, response } = this.views;
        const { result } = response;
        if (!response.following || !result || response.isOld) return;
        if (response.chosen) return requests.showOrbit();
        if (response.isOutside) {
            this.clear(`${quantity(response.at!, result.unit, 5)} is outside the shown range`);
            this.extend.hidden = false;
        } else if (!point.attractor && result.draft) this.clear("Orbit: its branch is being searched");
        else this.clear(`No branch ${result.draft ? "found so far" : "found"} has the attractor of the operating point; select another point for its orbit`);
    }
}
