// Strain on the branches of a response: computed by the server once it is shown.

import type { ResponseResult } from "./branches";
import type { Head } from "./frame";
import type { Response } from "./response";
import type { Wire } from "./wire";

/** Parts in a million. */
const PPM = 1e6;

/** Smallest strain limit of the patches in an orbit, ppm. */
export function strainLimit({ limits }: Head): number | undefined {
    const found = ((limits ?? []) as { quantity: string; limits: [number, number] }[]).filter(({ quantity }) => quantity === "strain").map((own) => PPM * own.limits[1]);
    return found.length > 0 ? Math.min(...found) : undefined;
}

export class Strain {
    /** Response for which it was requested. */
    private requested: ResponseResult | undefined;

    constructor(private readonly wire: Wire, private readonly response: Response, private readonly reply: (words: string) => void) {
        wire.on("strain", (frame) => {
            const { result } = response;
            if (frame.head.stage === "fault") return this.reply(frame.head.faults[0]?.message ?? "");
            if (!result || frame.head.response !== result.id || result !== this.requested) return;
            result.branches.forEach((branch, k) => (branch.values.strain = frame.array(`${k}.strain`).map((own) => PPM * own)));
            response.draw();
        });
    }

    /** Requests the strain where it is shown and not known. */
    show(): void {
        const { result, quantity } = this.response;
        if (quantity !== "strain" || !result || result === this.requested || result.branches.every(({ values }) => values.strain.length > 0)) return;
        this.requested = this.wire.ask("strain", { response: result.id }) === 0 ? undefined : result;
    }
}
