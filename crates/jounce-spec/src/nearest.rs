//! Search for the known word nearest to an unknown word.

pub(super) use jounce_units::clip;

/// Longest word that is compared; the distance of two long words is slow to compute.
const MAX_WORD_LENGTH: usize = 64;

/// Largest number of candidates that are compared, so a huge file with many wrong names is refused
/// in bounded time.
const MAX_CANDIDATES: usize = 2000;

/// Largest number of known words in a message.
const MAX_LISTED_WORDS: usize = 13;

/// Shortest beginning of a word that stands for the word.
const MIN_PREFIX_LENGTH: usize = 3;

/// Returns the shortest candidate of which the word is the beginning, except for a path below it;
/// without one, the nearest candidate within one edit per three characters, and at least one edit;
/// without one, the longest candidate that the word contains at its beginning or between separators.
pub fn nearest<'c>(word: &str, candidates: &[&'c str]) -> Option<&'c str> {
    let length = word.chars().count();
    if length > MAX_WORD_LENGTH {
        return None;
    }
    let mut near = candidates[..candidates.len().min(MAX_CANDIDATES)].to_vec();
    near.retain(|candidate| candidate.len() <= MAX_WORD_LENGTH);
    let is_begun = |candidate: &&&str| {
        let rest = candidate.strip_prefix(word);
        length >= MIN_PREFIX_LENGTH && rest.is_some_and(|rest| !rest.contains('.'))
    };
    if let Some(complete) = near.iter().filter(is_begun).min_by_key(|word| word.len()) {
        return Some(complete);
    }
    let (distance, best) = near
        .iter()
        .map(|candidate| (strsim::damerau_levenshtein(word, candidate), *candidate))
        .min_by_key(|(distance, _)| *distance)?;
    if distance <= (length / 3).max(1) {
        return Some(best);
    }
    near.into_iter()
        .filter(|candidate| contains(word, candidate))
        .max_by_key(|candidate| candidate.len())
}

/// True where a word has another word at its beginning or between separators, as `hertzian` and
/// `spring steel`; a path does not contain those above it.
fn contains(word: &str, candidate: &str) -> bool {
    let begins = word
        .strip_prefix(candidate)
        .is_some_and(|rest| !rest.contains('.'));
    let mut parts = word.split([' ', '-', '_']);
    candidate.len() >= MIN_PREFIX_LENGTH && (begins || parts.any(|part| part == candidate))
}

/// Returns ` (did you mean X?)`, or an empty text.
pub fn did_you_mean(word: &str, candidates: &[&str]) -> String {
    nearest(word, candidates)
        .map(|near| format!(" (did you mean `{near}`?)"))
        .unwrap_or_default()
}

/// Returns a list for a message: `a, b, c and 5 more`.
pub(super) fn join_words(words: &[&str]) -> String {
    let mut words = words.to_vec();
    words.dedup();
    let quoted = words
        .iter()
        .take(MAX_LISTED_WORDS)
        .map(|word| clip(word))
        .collect::<Vec<_>>()
        .join(", ");
    if words.len() > MAX_LISTED_WORDS {
        format!("{quoted} and {} more", words.len() - MAX_LISTED_WORDS)
    } else {
        quoted
    }
}

/// Returns `KEY is ...` if the text starts with a verb, otherwise `KEY: ...`.
pub(super) fn sentence(key: &str, text: &str) -> String {
    let reads_on = ["is ", "has ", "does "]
        .iter()
        .any(|verb| text.starts_with(verb));
    format!("{}{} {text}", clip(key), if reads_on { "" } else { ":" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspellings_find_their_word_and_others_do_not() {
        let keys = ["stiffness", "gap", "law"];
        assert_eq!(nearest("stifness", &keys), Some("stiffness"));
        assert_eq!(nearest("gpa", &keys), Some("gap"));
        assert_eq!(nearest("colour", &keys), None);
        assert_eq!(nearest(&"gap".repeat(100), &keys), None);
    }

    #[test]
    fn the_beginning_of_a_word_finds_it_before_a_word_of_similar_letters() {
        let keys = ["from", "frequency", "force", "force_n", "stop.tip.gap"];
        assert_eq!(nearest("freq", &keys), Some("frequency"));
        assert_eq!(nearest("forc", &keys), Some("force"));
        assert_eq!(nearest("fr", &keys), None);
        assert_eq!(nearest("stop", &keys), None);
        assert_eq!(nearest("stop.tip.ga", &keys), Some("stop.tip.gap"));
    }

    #[test]
    fn a_word_with_more_letters_finds_the_word_that_it_contains() {
        let laws = ["hertz", "spring", "rigid"];
        assert_eq!(nearest("hertzian", &laws), Some("hertz"));
        assert_eq!(nearest("linear spring", &laws), Some("spring"));
        assert_eq!(nearest("mainspring", &laws), None);
        let metals = ["aluminium", "steel", "stainless-steel"];
        assert_eq!(nearest("spring steel", &metals), Some("steel"));
        assert_eq!(nearest("stop.tip.gap.uncertainty", &["stop.tip.gap"]), None);
    }

    #[test]
    fn long_lists_are_cut() {
        let names: Vec<String> = (0..20).map(|i| i.to_string()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        assert_eq!(
            join_words(&names),
            "0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 and 7 more"
        );
    }
}
