// Nearest point of drawn curves to a position.

export interface Drawn {
    count: number;
    /** Position of a point, CSS pixels; not finite where it is not drawn. */
    place: (point: number) => [number, number];
    /** True where the segment from a point to the next is not drawn. */
    gap?: (from: number) => boolean;
}

export interface Nearest {
    curve: number;
    point: number;
    /** Distance of the position from the curve, CSS pixels. */
    away: number;
}

/** The curve that passes nearest to a position, and the nearer end of its nearest segment. */
export function nearestPoint([x, y]: [number, number], curves: Drawn[]): Nearest | undefined {
    let found: Nearest | undefined;
    curves.forEach(({ count, place, gap }, curve) => {
        let before: [number, number] | undefined;
        for (let point = 0; point < count; point++) {
            const at = place(point);
            const isDrawn = Number.isFinite(at[0]) && Number.isFinite(at[1]);
            if (isDrawn) {
                const from = before && !gap?.(point - 1) ? before : at;
                const share = along([x, y], from, at);
                const away = Math.hypot(from[0] + share * (at[0] - from[0]) - x, from[1] + share * (at[1] - from[1]) - y);
                if (away < (found?.away ?? Infinity)) found = { curve, point: from !== at && share < 0.5 ? point - 1 : point, away };
            }
            before = isDrawn ? at : undefined;
        }
    });
    return found;
}

/** Share of a segment at which it is nearest to a position. */
function along([x, y]: [number, number], [a, b]: [number, number], [c, d]: [number, number]): number {
    const size = (c - a) ** 2 + (d - b) ** 2;
    return size > 0 ? Math.min(Math.max(((x - a) * (c - a) + (y - b) * (d - b)) / size, 0), 1) : 1;
}
