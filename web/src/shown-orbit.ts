// The orbit in the panel: whether it is that of the present design, and which attractor it is.

import { type ResponseResult, isSamePower } from "./branches";
import type { Design } from "./design";
import type { Head } from "./frame";
import type { Response } from "./response";

/** An attractor, as far as an orbit is compared with it. */
interface Compared {
    period_cycles: number;
    mean_power_w: number;
}

export class ShownOrbit {
    private head: Head | undefined;
    private of: ResponseResult | undefined;

    constructor(private readonly response: Response, private readonly design: Design) {}

    /** Registers the orbit of a response that the panel shows; nothing where it shows words. */
    take(head?: Head, of?: ResponseResult): void {
        [this.head, this.of] = [head, of];
    }

    /** The orbit, where it is that of the present design. */
    get present(): Head | undefined {
        const { head, of } = this;
        return head && of && !this.design.isOld(of) && head.parameter === this.response.at ? head : undefined;
    }

    /** The attractor, of some of the present design, whose orbit is shown. */
    among<T extends Compared>(attractors: T[]): T | undefined {
        const orbit = this.present;
        if (!orbit?.stable) return undefined;
        const away = (own: T) => Math.abs(Math.log(own.mean_power_w / orbit.mean_power_w));
        const same = attractors.filter((own) => own.period_cycles === orbit.period_cycles && isSamePower(own.mean_power_w, orbit.mean_power_w));
        return same.sort((a, b) => away(a) - away(b))[0];
    }
}
