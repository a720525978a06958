//! Numbers and texts in CDR, the encoding of ROS 2 messages.
//!
//! Own code: a message is read by the few fields that are known, without copying, and nothing is allocated by a length
//! that stands in the message.

use std::fmt;

/// What is wrong with a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Malformed {
    /// It ends within a field.
    Short,
    /// Its first bytes name an encoding that is not read here.
    Encoding(u16),
    /// A text is not UTF-8.
    Text,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Short => write!(f, "it ends too early"),
            Self::Encoding(id) => write!(f, "its encoding {id:#06x} is not plain CDR"),
            Self::Text => write!(f, "a text in it is not UTF-8"),
        }
    }
}

pub(crate) type Read<T> = Result<T, Malformed>;

/// A message being read.
pub(crate) struct Cdr<'a> {
    /// The bytes behind the four that name the encoding.
    body: &'a [u8],
    at: usize,
    little: bool,
    /// Largest alignment.
    widest: usize,
}

impl<'a> Cdr<'a> {
    /// Plain CDR of version 1 or 2, of either byte order.
    pub fn new(message: &'a [u8]) -> Read<Self> {
        let (start, body) = message.split_at_checked(4).ok_or(Malformed::Short)?;
        let id = u16::from_be_bytes([start[0], start[1]]);
        let (little, widest) = match id {
            0 => (false, 8),
            1 => (true, 8),
            6 => (false, 4),
            7 => (true, 4),
            other => return Err(Malformed::Encoding(other)),
        };
        Ok(Self { body, at: 0, little, widest })
    }

    fn bytes<const N: usize>(&mut self) -> Read<[u8; N]> {
        let start = self.at.next_multiple_of(N.min(self.widest));
        let found = self.body.get(start..).and_then(|b| b.first_chunk::<N>()).ok_or(Malformed::Short)?;
        self.at = start + N;
        Ok(*found)
    }

    pub fn u32(&mut self) -> Read<u32> {
        let b = self.bytes()?;
        Ok(if self.little { u32::from_le_bytes(b) } else { u32::from_be_bytes(b) })
    }

    pub fn f64(&mut self) -> Read<f64> {
        let b = self.bytes()?;
        Ok(if self.little { f64::from_le_bytes(b) } else { f64::from_be_bytes(b) })
    }

    /// The bits of a number of one, two, four or eight bytes.
    pub fn integer(&mut self, bytes: usize) -> Read<u64> {
        let start = self.at.next_multiple_of(bytes.min(self.widest));
        let found = self.body.get(start..).and_then(|b| b.get(..bytes)).ok_or(Malformed::Short)?;
        self.at = start + bytes;
        let join = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
        Ok(if self.little { found.iter().rev().fold(0, join) } else { found.iter().fold(0, join) })
    }

    /// Passes over numbers of so many bytes each, one after another.
    pub fn skip(&mut self, count: usize, bytes: usize) -> Read<()> {
        let start = self.at.next_multiple_of(bytes.min(self.widest));
        let end = count.checked_mul(bytes).and_then(|n| start.checked_add(n)).ok_or(Malformed::Short)?;
        self.at = end.min(self.body.len());
        if end > self.body.len() { Err(Malformed::Short) } else { Ok(()) }
    }

    /// A text without its closing zero.
    pub fn text(&mut self) -> Read<&'a str> {
        let length = self.u32()? as usize;
        let bytes = self.body.get(self.at..).and_then(|b| b.get(..length)).ok_or(Malformed::Short)?;
        self.at += length;
        let bytes = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        std::str::from_utf8(bytes).map_err(|_| Malformed::Text)
    }

    /// Texts, one after another.
    pub fn texts(&mut self) -> Read<Vec<&'a str>> {
        let count = self.u32()?;
        let mut found = Vec::new();
        for _ in 0..count {
            found.push(self.text()?);
        }
        Ok(found)
    }

    /// Numbers, one after another.
    pub fn numbers(&mut self) -> Read<Vec<f64>> {
        let count = self.u32()?;
        let mut found = Vec::new();
        for _ in 0..count {
            found.push(self.f64()?);
        }
        Ok(found)
    }

    /// A time as whole seconds and nanoseconds, s.
    pub fn stamp(&mut self) -> Read<f64> {
        let seconds = self.u32()? as i32;
        Ok(f64::from(seconds) + f64::from(self.u32()?) * 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_aligned_behind_the_encoding() {
        let mut message = vec![0, 1, 0, 0];
        message.extend(3u32.to_le_bytes());
        message.extend(b"ab\0\0");
        message.extend(1.5f64.to_le_bytes());
        let mut cdr = Cdr::new(&message).unwrap();
        assert_eq!((cdr.text(), cdr.f64(), cdr.f64()), (Ok("ab"), Ok(1.5), Err(Malformed::Short)));
    }

    #[test]
    fn either_byte_order_and_both_versions() {
        for (id, big, pad) in [(0u8, true, 4), (1, false, 4), (6, true, 0), (7, false, 0)] {
            let mut message = vec![0, id, 0, 0];
            message.extend(if big { 7u32.to_be_bytes() } else { 7u32.to_le_bytes() });
            message.extend(vec![0; pad]);
            message.extend(if big { 2.5f64.to_be_bytes() } else { 2.5f64.to_le_bytes() });
            let mut cdr = Cdr::new(&message).unwrap();
            assert_eq!((cdr.u32(), cdr.f64()), (Ok(7), Ok(2.5)), "{id}");
        }
        assert_eq!(Cdr::new(&[0, 2, 0, 0]).err(), Some(Malformed::Encoding(2)));
        assert_eq!(Cdr::new(&[0, 1]).err(), Some(Malformed::Short));
    }

    #[test]
    fn a_length_beyond_the_message_allocates_nothing() {
        let message = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 1, 2];
        assert_eq!(Cdr::new(&message).unwrap().text(), Err(Malformed::Short));
        assert_eq!(Cdr::new(&message).unwrap().numbers(), Err(Malformed::Short));
        assert_eq!(Cdr::new(&message).unwrap().texts(), Err(Malformed::Short));
    }
}
