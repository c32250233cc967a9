// Difference of two texts by lines.

/** Lines that only one of two texts has, in their order: "-" for the first, "+" for the second. */
export function difference(before: string, after: string): string[] {
    const [a, b] = [before.split("\n"), after.split("\n")];
    // Length of the longest common sequence of lines from each pair of lines on.
    const common = Array.from({ length: a.length + 1 }, () => new Uint32Array(b.length + 1));
    for (let i = a.length - 1; i >= 0; i--) {
        for (let j = b.length - 1; j >= 0; j--) common[i][j] = a[i] === b[j] ? common[i + 1][j + 1] + 1 : Math.max(common[i + 1][j], common[i][j + 1]);
    }
    const found: string[] = [];
    let [i, j] = [0, 0];
    while (i < a.length || j < b.length) {
        if (i < a.length && j < b.length && a[i] === b[j]) [i, j] = [i + 1, j + 1];
        else if (j === b.length || (i < a.length && common[i + 1][j] >= common[i][j + 1])) found.push(`- ${a[i++]}`);
        else found.push(`+ ${b[j++]}`);
    }
    return found;
}
