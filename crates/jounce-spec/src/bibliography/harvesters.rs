//! Publications that describe a harvester or an oscillator.

use super::{ARTICLE, COLLECTION, Publication, PublicationKind};

pub(super) const ENTRIES: &[Publication] = &[
    Publication {
        key: "impact-harvester-2019",
        kind: PublicationKind::Other,
        title: "Experimental validation of an impact off-resonance energy harvester",
        year: 2019,
        ..ARTICLE
    },
    Publication {
        key: "erturk-inman-2008",
        authors: &["Erturk, A.", "Inman, D. J."],
        title: "A distributed parameter electromechanical model for cantilevered piezoelectric energy harvesters",
        container: "Journal of Vibration and Acoustics",
        volume: "130",
        number: "4",
        pages: "041002",
        year: 2008,
        doi: "10.1115/1.2890402",
        ..ARTICLE
    },
    Publication {
        key: "erturk-inman-2009",
        authors: &["Erturk, A.", "Inman, D. J."],
        title: "An experimentally validated bimorph cantilever model for piezoelectric energy harvesting from base excitations",
        container: "Smart Materials and Structures",
        volume: "18",
        number: "2",
        pages: "025009",
        year: 2009,
        doi: "10.1088/0964-1726/18/2/025009",
        ..ARTICLE
    },
    Publication {
        key: "de-marqui-2009",
        authors: &["De Marqui Junior, C.", "Erturk, A.", "Inman, D. J."],
        title: "An electromechanical finite element model for piezoelectric energy harvester plates",
        container: "Journal of Sound and Vibration",
        volume: "327",
        pages: "9–25",
        year: 2009,
        doi: "10.1016/j.jsv.2009.05.015",
        ..ARTICLE
    },
    Publication {
        key: "adhikari-2009",
        authors: &["Adhikari, S.", "Friswell, M. I.", "Inman, D. J."],
        title: "Piezoelectric energy harvesting from broadband random vibrations",
        container: "Smart Materials and Structures",
        volume: "18",
        number: "11",
        pages: "115005",
        year: 2009,
        doi: "10.1088/0964-1726/18/11/115005",
        ..ARTICLE
    },
    Publication {
        key: "umeda-1996",
        authors: &["Umeda, M.", "Nakamura, K.", "Ueha, S."],
        title: "Analysis of the transformation of mechanical impact energy to electric energy using piezoelectric vibrator",
        container: "Japanese Journal of Applied Physics",
        volume: "35",
        pages: "3267–3273",
        year: 1996,
        doi: "10.1143/JJAP.35.3267",
        ..ARTICLE
    },
    Publication {
        key: "cavallier-2005",
        authors: &[
            "Cavallier, B.",
            "Berthelot, P.",
            "Nouira, H.",
            "Foltête, E.",
            "Hirsinger, L.",
            "Ballandras, S.",
        ],
        title: "Energy harvesting using vibrating structures excited by shock",
        container: "IEEE Ultrasonics Symposium",
        pages: "943–945",
        year: 2005,
        ..COLLECTION
    },
    Publication {
        key: "renaud-2009",
        authors: &[
            "Renaud, M.",
            "Fiorini, P.",
            "van Schaijk, R.",
            "van Hoof, C.",
        ],
        title: "Harvesting energy from the motion of human limbs: the design and analysis of an impact-based piezoelectric generator",
        container: "Smart Materials and Structures",
        volume: "18",
        number: "3",
        pages: "035001",
        year: 2009,
        doi: "10.1088/0964-1726/18/3/035001",
        ..ARTICLE
    },
    Publication {
        key: "jacquelin-2011",
        authors: &["Jacquelin, E.", "Adhikari, S.", "Friswell, M. I."],
        title: "A piezoelectric device for impact energy harvesting",
        container: "Smart Materials and Structures",
        volume: "20",
        number: "10",
        pages: "105008",
        year: 2011,
        doi: "10.1088/0964-1726/20/10/105008",
        ..ARTICLE
    },
    Publication {
        key: "gu-livermore-2011",
        authors: &["Gu, L.", "Livermore, C."],
        title: "Impact-driven, frequency up-converting coupled vibration energy harvesting device for low frequency operation",
        container: "Smart Materials and Structures",
        volume: "20",
        number: "4",
        pages: "045004",
        year: 2011,
        doi: "10.1088/0964-1726/20/4/045004",
        ..ARTICLE
    },
    Publication {
        key: "gu-2011",
        authors: &["Gu, L."],
        title: "Low-frequency piezoelectric energy harvesting prototype suitable for the MEMS implementation",
        container: "Microelectronics Journal",
        volume: "42",
        pages: "277–282",
        year: 2011,
        ..ARTICLE
    },
    Publication {
        key: "vijayan-2015",
        authors: &[
            "Vijayan, K.",
            "Friswell, M. I.",
            "Haddad Khodaparast, H.",
            "Adhikari, S.",
        ],
        title: "Non-linear energy harvesting from coupled impacting beams",
        container: "International Journal of Mechanical Sciences",
        volume: "96–97",
        pages: "101–109",
        year: 2015,
        ..ARTICLE
    },
    Publication {
        key: "bilgen-2010",
        authors: &["Bilgen, O.", "Erturk, A.", "Inman, D. J."],
        title: "Analytical and experimental characterization of macro-fiber composite actuated thin clamped-free unimorph benders",
        container: "Journal of Vibration and Acoustics",
        volume: "132",
        number: "5",
        pages: "051005",
        year: 2010,
        ..ARTICLE
    },
    Publication {
        key: "martinez-ayuso-2018",
        authors: &[
            "Martínez-Ayuso, G.",
            "Haddad Khodaparast, H.",
            "Zhang, Y.",
            "Bowen, C. R.",
            "Friswell, M. I.",
            "Shaw, A. D.",
            "Madinei, H.",
        ],
        title: "Model validation of a porous piezoelectric energy harvester using vibration test data",
        container: "Vibration",
        volume: "1",
        number: "1",
        pages: "123–137",
        year: 2018,
        ..ARTICLE
    },
    Publication {
        key: "shaw-holmes-1983",
        authors: &["Shaw, S. W.", "Holmes, P. J."],
        title: "A periodically forced piecewise linear oscillator",
        container: "Journal of Sound and Vibration",
        volume: "90",
        number: "1",
        pages: "129–155",
        year: 1983,
        doi: "10.1016/0022-460X(83)90407-8",
        ..ARTICLE
    },
    Publication {
        key: "holmes-1982",
        authors: &["Holmes, P. J."],
        title: "The dynamics of repeated impacts with a sinusoidally vibrating table",
        container: "Journal of Sound and Vibration",
        volume: "84",
        number: "2",
        pages: "173–189",
        year: 1982,
        doi: "10.1016/S0022-460X(82)80002-3",
        ..ARTICLE
    },
    Publication {
        key: "falcon-1998",
        authors: &["Falcon, E.", "Laroche, C.", "Fauve, S.", "Coste, C."],
        title: "Behavior of one inelastic ball bouncing repeatedly off the ground",
        container: "European Physical Journal B",
        volume: "3",
        pages: "45–57",
        year: 1998,
        doi: "10.1007/s100510050283",
        ..ARTICLE
    },
];
