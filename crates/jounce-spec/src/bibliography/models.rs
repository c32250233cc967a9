//! Publications behind models: sections, plates, materials, contact laws, circuits.

use super::{ARTICLE, BOOK, COLLECTION, Publication};

pub(super) const ENTRIES: &[Publication] = &[
    Publication {
        key: "erturk-inman-2011",
        authors: &["Erturk, A.", "Inman, D. J."],
        title: "Piezoelectric Energy Harvesting",
        publisher: "Wiley",
        year: 2011,
        doi: "10.1002/9781119991151",
        ..BOOK
    },
    Publication {
        key: "szabo-babuska-1991",
        authors: &["Szabó, B.", "Babuška, I."],
        title: "Finite Element Analysis",
        publisher: "Wiley",
        year: 1991,
        ..BOOK
    },
    Publication {
        key: "bogner-1966",
        authors: &["Bogner, F. K.", "Fox, R. L.", "Schmit, L. A."],
        title: "The generation of inter-element-compatible stiffness and mass matrices by the use of interpolation formulas",
        container: "Proceedings of the Conference on Matrix Methods in Structural Mechanics, AFFDL-TR-66-80",
        pages: "397–443",
        year: 1966,
        ..COLLECTION
    },
    Publication {
        key: "reddy-2004",
        authors: &["Reddy, J. N."],
        title: "Mechanics of Laminated Composite Plates and Shells: Theory and Analysis",
        publisher: "CRC Press",
        year: 2004,
        ..BOOK
    },
    Publication {
        key: "dunn-taya-1993",
        authors: &["Dunn, M. L.", "Taya, M."],
        title: "Micromechanics predictions of the effective electroelastic moduli of piezoelectric composites",
        container: "International Journal of Solids and Structures",
        volume: "30",
        number: "2",
        pages: "161–175",
        year: 1993,
        doi: "10.1016/0020-7683(93)90058-F",
        ..ARTICLE
    },
    Publication {
        key: "martinez-ayuso-2017",
        authors: &[
            "Martínez-Ayuso, G.",
            "Friswell, M. I.",
            "Adhikari, S.",
            "Haddad Khodaparast, H.",
            "Berger, H.",
        ],
        title: "Homogenization of porous piezoelectric materials",
        container: "International Journal of Solids and Structures",
        volume: "113–114",
        pages: "218–229",
        year: 2017,
        ..ARTICLE
    },
    Publication {
        key: "jaffe-1971",
        authors: &["Jaffe, B.", "Cook, W. R.", "Jaffe, H."],
        title: "Piezoelectric Ceramics",
        publisher: "Academic Press",
        year: 1971,
        ..BOOK
    },
    Publication {
        key: "hopcroft-2010",
        authors: &["Hopcroft, M. A.", "Nix, W. D.", "Kenny, T. W."],
        title: "What is the Young's modulus of silicon?",
        container: "Journal of Microelectromechanical Systems",
        volume: "19",
        number: "2",
        pages: "229–238",
        year: 2010,
        doi: "10.1109/JMEMS.2009.2039697",
        ..ARTICLE
    },
    Publication {
        key: "hertz-1881",
        authors: &["Hertz, H."],
        title: "Ueber die Berührung fester elastischer Körper",
        container: "Journal für die reine und angewandte Mathematik",
        volume: "92",
        pages: "156–171",
        year: 1882,
        doi: "10.1515/crll.1882.92.156",
        ..ARTICLE
    },
    Publication {
        key: "johnson-1985",
        authors: &["Johnson, K. L."],
        title: "Contact Mechanics",
        publisher: "Cambridge University Press",
        year: 1985,
        doi: "10.1017/CBO9781139171731",
        ..BOOK
    },
    Publication {
        key: "hunt-crossley-1975",
        authors: &["Hunt, K. H.", "Crossley, F. R. E."],
        title: "Coefficient of restitution interpreted as damping in vibroimpact",
        container: "Journal of Applied Mechanics",
        volume: "42",
        number: "2",
        pages: "440–445",
        year: 1975,
        doi: "10.1115/1.3423596",
        ..ARTICLE
    },
    Publication {
        key: "kovacic-brennan-2011",
        authors: &["Kovacic, I.", "Brennan, M. J."],
        title: "The Duffing Equation: Nonlinear Oscillators and their Behaviour",
        publisher: "Wiley",
        year: 2011,
        doi: "10.1002/9780470977859",
        ..BOOK
    },
    Publication {
        key: "fritsch-butland-1984",
        authors: &["Fritsch, F. N.", "Butland, J."],
        title: "A method for constructing local monotone piecewise cubic interpolants",
        container: "SIAM Journal on Scientific and Statistical Computing",
        volume: "5",
        number: "2",
        pages: "300–304",
        year: 1984,
        doi: "10.1137/0905021",
        ..ARTICLE
    },
    Publication {
        key: "moreau-1988",
        authors: &["Moreau, J. J."],
        title: "Unilateral contact and dry friction in finite freedom dynamics",
        container: "Nonsmooth Mechanics and Applications, CISM Courses and Lectures 302",
        pages: "1–82",
        publisher: "Springer",
        year: 1988,
        doi: "10.1007/978-3-7091-2624-0_1",
        ..COLLECTION
    },
    Publication {
        key: "shu-lien-2006",
        authors: &["Shu, Y. C.", "Lien, I. C."],
        title: "Analysis of power output for piezoelectric energy harvesting systems",
        container: "Smart Materials and Structures",
        volume: "15",
        number: "6",
        pages: "1499–1512",
        year: 2006,
        doi: "10.1088/0964-1726/15/6/001",
        ..ARTICLE
    },
    Publication {
        key: "guyomar-2005",
        authors: &["Guyomar, D.", "Badel, A.", "Lefeuvre, E.", "Richard, C."],
        title: "Toward energy harvesting using active materials and conversion improvement by nonlinear processing",
        container: "IEEE Transactions on Ultrasonics, Ferroelectrics, and Frequency Control",
        volume: "52",
        number: "4",
        pages: "584–595",
        year: 2005,
        doi: "10.1109/TUFFC.2005.1428041",
        ..ARTICLE
    },
    Publication {
        key: "lefeuvre-2006",
        authors: &[
            "Lefeuvre, E.",
            "Badel, A.",
            "Richard, C.",
            "Petit, L.",
            "Guyomar, D.",
        ],
        title: "A comparison between several vibration-powered piezoelectric generators for standalone systems",
        container: "Sensors and Actuators A: Physical",
        volume: "126",
        number: "2",
        pages: "405–416",
        year: 2006,
        doi: "10.1016/j.sna.2005.10.043",
        ..ARTICLE
    },
];
