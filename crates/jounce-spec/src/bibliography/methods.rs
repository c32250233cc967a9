//! Publications behind methods: signals, statistics, continuation, attractors.

use super::{ARTICLE, BOOK, Publication};

pub(super) const ENTRIES: &[Publication] = &[
    Publication {
        key: "shinozuka-jan-1972",
        authors: &["Shinozuka, M.", "Jan, C.-M."],
        title: "Digital simulation of random processes and its applications",
        container: "Journal of Sound and Vibration",
        volume: "25",
        number: "1",
        pages: "111–128",
        year: 1972,
        doi: "10.1016/0022-460X(72)90600-1",
        ..ARTICLE
    },
    Publication {
        key: "gawronski-juang-1990",
        authors: &["Gawronski, W.", "Juang, J.-N."],
        title: "Model reduction in limited time and frequency intervals",
        container: "International Journal of Systems Science",
        volume: "21",
        number: "2",
        pages: "349–376",
        year: 1990,
        doi: "10.1080/00207729008910366",
        ..ARTICLE
    },
    Publication {
        key: "rice-1945",
        authors: &["Rice, S. O."],
        title: "Mathematical analysis of random noise",
        container: "Bell System Technical Journal",
        volume: "24",
        number: "1",
        pages: "46–156",
        year: 1945,
        doi: "10.1002/j.1538-7305.1945.tb00453.x",
        ..ARTICLE
    },
    Publication {
        key: "bendat-piersol-2010",
        authors: &["Bendat, J. S.", "Piersol, A. G."],
        title: "Random Data: Analysis and Measurement Procedures",
        publisher: "Wiley",
        year: 2010,
        doi: "10.1002/9781118032428",
        ..BOOK
    },
    Publication {
        key: "efron-stein-1981",
        authors: &["Efron, B.", "Stein, C."],
        title: "The jackknife estimate of variance",
        container: "Annals of Statistics",
        volume: "9",
        number: "3",
        pages: "586–596",
        year: 1981,
        doi: "10.1214/aos/1176345462",
        ..ARTICLE
    },
    Publication {
        key: "davis-rabinowitz-1984",
        authors: &["Davis, P. J.", "Rabinowitz, P."],
        title: "Methods of Numerical Integration",
        publisher: "Academic Press",
        year: 1984,
        ..BOOK
    },
    Publication {
        key: "doedel-1991",
        authors: &["Doedel, E.", "Keller, H. B.", "Kernevez, J. P."],
        title: "Numerical analysis and control of bifurcation problems (I): bifurcation in finite dimensions",
        container: "International Journal of Bifurcation and Chaos",
        volume: "1",
        number: "3",
        pages: "493–520",
        year: 1991,
        doi: "10.1142/S0218127491000397",
        ..ARTICLE
    },
    Publication {
        key: "govaerts-2000",
        authors: &["Govaerts, W. J. F."],
        title: "Numerical Methods for Bifurcations of Dynamical Equilibria",
        publisher: "SIAM",
        year: 2000,
        doi: "10.1137/1.9780898719543",
        ..BOOK
    },
    Publication {
        key: "kuznetsov-2004",
        authors: &["Kuznetsov, Y. A."],
        title: "Elements of Applied Bifurcation Theory",
        publisher: "Springer",
        year: 2004,
        doi: "10.1007/978-1-4757-3978-7",
        ..BOOK
    },
    Publication {
        key: "nordmark-1991",
        authors: &["Nordmark, A. B."],
        title: "Non-periodic motion caused by grazing incidence in an impact oscillator",
        container: "Journal of Sound and Vibration",
        volume: "145",
        number: "2",
        pages: "279–297",
        year: 1991,
        doi: "10.1016/0022-460X(91)90592-8",
        ..ARTICLE
    },
    Publication {
        key: "wilson-1927",
        authors: &["Wilson, E. B."],
        title: "Probable inference, the law of succession, and statistical inference",
        container: "Journal of the American Statistical Association",
        volume: "22",
        number: "158",
        pages: "209–212",
        year: 1927,
        doi: "10.1080/01621459.1927.10502953",
        ..ARTICLE
    },
    Publication {
        key: "van-den-berg-lessard-2015",
        authors: &["van den Berg, J. B.", "Lessard, J.-P."],
        title: "Rigorous numerics in dynamics",
        container: "Notices of the American Mathematical Society",
        volume: "62",
        number: "9",
        pages: "1057–1063",
        year: 2015,
        ..ARTICLE
    },
    Publication {
        key: "das-2017",
        authors: &["Das, S.", "Saiki, Y.", "Sander, E.", "Yorke, J. A."],
        title: "Quantitative quasiperiodicity",
        container: "Nonlinearity",
        volume: "30",
        number: "11",
        pages: "4111–4140",
        year: 2017,
        doi: "10.1088/1361-6544/aa84c2",
        ..ARTICLE
    },
];
