//! Bytes become text.

use super::headings::has_chinese_word;
use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{Encoding, GB18030, GBK, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// So many bytes decide about UTF-16 without a byte order mark.
const HEAD: usize = 4096;

/// A text with the name of its encoding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decoded {
    /// The text, without a byte order mark.
    pub text: String,
    /// Its encoding by the name of the WHATWG standard, such as `UTF-8`, `windows-1252`, `GBK`.
    pub encoding: &'static str,
    /// Whether nothing in the file proves that encoding.
    pub is_assumed: bool,
}

/// The text of a file of any usual encoding: by its byte order mark, as UTF-8 where it is that, else as its bytes suggest.
///
/// ```
/// use trueaxis_input::foreign::decode;
/// let read = decode(b"Abweichung [\xb5m]");
/// assert_eq!((read.text.as_str(), read.encoding, read.is_assumed), ("Abweichung [µm]", "windows-1252", true));
/// ```
pub fn decode(bytes: &[u8]) -> Decoded {
    if let Some((encoding, mark)) = Encoding::for_bom(bytes) {
        return with(encoding, &bytes[mark..], false);
    }
    if let Some(encoding) = utf_16_without_mark(bytes) {
        return with(encoding, bytes, true);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Decoded { text: text.to_owned(), encoding: UTF_8.name(), is_assumed: false },
        Err(_) => with(guess(bytes), bytes, true),
    }
}

/// The text in an encoding that a user stated; a byte order mark of that encoding is left out.
pub fn decode_as(bytes: &[u8], encoding: &'static Encoding) -> Decoded {
    let (text, used, _) = encoding.decode(bytes);
    Decoded { text: text.into_owned(), encoding: used.name(), is_assumed: false }
}

/// An encoding by any name of the WHATWG standard (`latin1` and `windows-1252` are one, as are `gb2312` and `gbk`).
pub fn encoding_named(name: &str) -> Option<&'static Encoding> {
    Encoding::for_label(name.trim().as_bytes())
}

fn with(encoding: &'static Encoding, bytes: &[u8], is_assumed: bool) -> Decoded {
    let (text, _) = encoding.decode_without_bom_handling(bytes);
    Decoded { text: text.into_owned(), encoding: encoding.name(), is_assumed }
}

/// Headings and numbers are mostly ASCII: in UTF-16 every other byte of them is 0.
fn utf_16_without_mark(bytes: &[u8]) -> Option<&'static Encoding> {
    let head = &bytes[..bytes.len().min(HEAD)];
    let zeros = |first: usize| head.iter().skip(first).step_by(2).filter(|b| **b == 0).count();
    let (even, odd) = (zeros(0), zeros(1));
    let most = head.len() / 2;
    // Half of one kind of bytes and none of the other.
    match () {
        () if most > 0 && 2 * odd > most && even == 0 => Some(UTF_16LE),
        () if most > 0 && 2 * even > most && odd == 0 => Some(UTF_16BE),
        () => None,
    }
}

/// In western single-byte encodings µ, °, ± and the letters of German, French and Italian have the same places.
fn guess(bytes: &[u8]) -> &'static Encoding {
    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    let guess = detector.guess(None, Utf8Detection::Deny);
    let sound = |encoding: &'static Encoding| {
        encoding.decode_without_bom_handling_and_without_replacement(bytes).is_some()
    };
    // A lone µ or ° before an ASCII letter is also a character of GBK: two such bytes in a row are not.
    let high = |b: &u8| *b >= 0x80;
    let in_pairs = bytes.windows(2).any(|pair| pair.iter().all(high));
    let is_chinese = guess == GBK || guess == GB18030;
    let as_chinese = || GBK.decode_without_bom_handling_and_without_replacement(bytes);
    if in_pairs && as_chinese().is_some_and(|text| is_chinese || has_chinese_word(&text)) {
        return GBK;
    }
    let is_single = guess.is_single_byte() || !in_pairs || !sound(guess);
    if is_single && sound(WINDOWS_1252) { WINDOWS_1252 } else { guess }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_usual_encoding_gives_the_same_text() {
        let german = "Sollposition [mm];Rückwärts;Abweichung [µm]\r\n100,5;°;±1\r\n";
        let chinese = "目标位置(mm);方向;偏差(μm)\n100.5;正向;1\n";
        let utf_16 = |text: &str, big: bool, mark: bool| -> Vec<u8> {
            let mark = mark.then_some(0xFEFF);
            let units = mark.into_iter().chain(text.encode_utf16());
            units.flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
        };
        for text in [german, chinese] {
            assert_eq!(decode(text.as_bytes()).text, text);
            assert_eq!(decode(format!("\u{feff}{text}").as_bytes()).text, text);
            for (big, mark) in [(false, true), (true, true), (false, false), (true, false)] {
                if mark || text == german {
                    assert_eq!(decode(&utf_16(text, big, mark)).text, text, "{big} {mark}");
                }
            }
        }
        for (text, encoding) in [(german, WINDOWS_1252), (chinese, GBK)] {
            let (bytes, _, _) = encoding.encode(text);
            let read = decode(&bytes);
            assert_eq!((read.text.as_str(), read.is_assumed), (text, true), "{}", read.encoding);
            assert_eq!(decode_as(&bytes, encoding).text, text);
        }
        // Little to go by.
        for text in ["a [µm]", "Winkel [°];r", "écart (µm)\tx", "Rückwärts", "偏差"] {
            let encoding = if text == "偏差" { GBK } else { WINDOWS_1252 };
            let read = decode(&encoding.encode(text).0);
            assert_eq!(read.text, text, "{}", read.encoding);
        }
        assert_eq!(encoding_named("latin1"), encoding_named("Windows-1252"));
        assert_eq!(encoding_named("gb2312"), Some(GBK));
    }
}
