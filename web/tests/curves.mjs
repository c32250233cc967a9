// Comparison of the branches of two responses by their length.

/** Samples along each segment of a branch. */
const SAMPLES = 9;
/** Distance at which two curves are the same: a hundredth of the range, or 5 % of the power. */
const SAME = 0.01;
/** Whether each line of a branch of a draft is drawn. */
export const draws = ({ error }, draft) => error.map((own) => draft.error !== null && own <= draft.error);

/** Whether the drawn lines of a draft are no farther from its result than it says; `off` and `farthest` of their comparison. */
export const holds = ({ off, farthest }, draft) => off === 0 && farthest <= (draft.error ?? 0);

/** Tolerance of the searches: a power below this share of the largest one is the noise of the integrations. */
const TOLERANCE = 1e-9;

/** Drawn lines of branches on the scale of the comparison, with the period of each. */
function* lines(branches, span) {
    for (const { period, x, power, drawn } of branches) {
        for (let k = 0; k + 1 < x.length; k++) {
            if (drawn?.[k] !== false) yield { period, ends: [x[k] / span, 0.2 * Math.log(power[k]), x[k + 1] / span, 0.2 * Math.log(power[k + 1])] };
        }
    }
}

/** Branches with at least the power of the noise; a harvester without a load has no power. */
function aboveNoise(branches, others) {
    const largest = [...branches, ...others].flatMap(({ power }) => power).reduce((most, own) => Math.max(most, own), 0);
    const least = Math.max(TOLERANCE * largest, Number.MIN_VALUE);
    return branches.map((branch) => ({ ...branch, power: branch.power.map((own) => Math.max(own, least)) }));
}

/** Distance of a point from the nearest of some lines. */
function distance(x, y, others) {
    let least = Infinity;
    for (const [a, b, c, d] of others) {
        // Most lines are farther away in one direction than the nearest one.
        if (Math.max(Math.min(a, c) - x, x - Math.max(a, c), Math.min(b, d) - y, y - Math.max(b, d)) > least) continue;
        const size = (c - a) ** 2 + (d - b) ** 2;
        const share = size > 0 ? Math.min(Math.max(((x - a) * (c - a) + (y - b) * (d - b)) / size, 0), 1) : 0;
        least = Math.min(least, Math.hypot(a + share * (c - a) - x, b + share * (d - b) - y));
    }
    return least;
}

/** Share of the length of some branches that is not on others of the same period, and the largest distance. */
function strays(branches, others, span) {
    const same = new Map(others.map(({ period }) => [period, []]));
    for (const { period, ends } of lines(others, span)) same.get(period).push(ends);
    let [sum, off, farthest] = [0, 0, 0];
    for (const { period, ends: [a, b, c, d] } of lines(branches, span)) {
        const length = Math.hypot(c - a, d - b) / SAMPLES;
        for (let part = 0; part < SAMPLES; part++) {
            const share = part / (SAMPLES - 1);
            const away = distance(a + share * (c - a), b + share * (d - b), same.get(period) ?? []);
            sum += length;
            if (away > SAME) off += length;
            if (Number.isFinite(away)) farthest = Math.max(farthest, away);
        }
    }
    return { share: sum > 0 ? off / sum : 0, farthest };
}

/** Compares a response with the due one: the share of its length that is off, and of the due length that is missing. */
export function compare(shown, due, span) {
    const [own, others] = [aboveNoise(shown, due), aboveNoise(due, shown)];
    const off = strays(own, others, span);
    return { off: off.share, farthest: off.farthest, missing: strays(others, own, span).share };
}
