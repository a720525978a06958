//! The bytes of a log: hashed as they stand in the file, unpacked where they are packed.

use crate::error::{Error, Result};
use crate::files::toml::text::{hex, unreadable};
use ruzstd::decoding::{FrameDecoder, StreamingDecoder};
use sha2::{Digest, Sha256};
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes read at a time.
const BUFFER: usize = 1 << 16;
/// What packed files begin with.
const GZIP: &[u8] = b"\x1f\x8b";
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";

/// Unpacked bytes.
pub(crate) type Bytes = BufReader<Box<dyn Read + Send>>;

/// The hash of what has been read of a file.
#[derive(Clone, Default)]
pub(crate) struct Hash(Arc<Mutex<Sha256>>);

impl Hash {
    /// SHA-256 in hexadecimal.
    pub fn finish(&self) -> String {
        hex(&self.0.lock().unwrap_or_else(PoisonError::into_inner).clone().finalize())
    }
}

/// A reader that takes the hash of what passes.
struct Hashing<R> {
    input: R,
    hash: Hash,
}

impl<R: Read> Read for Hashing<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            match self.input.read(buffer) {
                // A signal on the way is no fault of the file.
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                read => {
                    return read.inspect(|&read| {
                        self.hash.0.lock().unwrap_or_else(PoisonError::into_inner).update(&buffer[..read]);
                    });
                }
            }
        }
    }
}

/// Frames of Zstandard, one after another.
struct Frames<R: Read> {
    decoder: Option<StreamingDecoder<R, FrameDecoder>>,
}

impl<R: BufRead> Frames<R> {
    fn of(input: R) -> io::Result<Self> {
        Ok(Self { decoder: Some(StreamingDecoder::new(input).map_err(io::Error::other)?) })
    }
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while let Some(mut decoder) = self.decoder.take() {
            let read = decoder.read(buffer)?;
            if read > 0 || buffer.is_empty() {
                self.decoder = Some(decoder);
                return Ok(read);
            }
            let mut rest = decoder.into_inner();
            if !rest.fill_buf()?.is_empty() {
                *self = Self::of(rest)?;
            }
        }
        Ok(0)
    }
}

/// The bytes that a reader gives, unpacked, and the hash of what it gives.
pub(crate) fn unpacked(input: impl Read + Send + 'static, path: &Path) -> Result<(Bytes, Hash)> {
    let hash = Hash::default();
    let mut raw = BufReader::with_capacity(BUFFER, Hashing { input, hash: hash.clone() });
    let start = raw.fill_buf().map_err(|e| unreadable(path, &e))?;
    let (gzip, zstd) = (start.starts_with(GZIP), start.starts_with(ZSTD));
    let bytes: Box<dyn Read + Send> = match (gzip, zstd) {
        (true, _) => Box::new(flate2::bufread::MultiGzDecoder::new(raw)),
        (_, true) => Box::new(Frames::of(raw).map_err(|e| {
            Error::input(format!("cannot be unpacked: {e}")).at_file(path).help("pack it again with zstd")
        })?),
        _ => return Ok((BufReader::with_capacity(BUFFER, Box::new(raw)), hash)),
    };
    Ok((BufReader::with_capacity(BUFFER, bytes), hash))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn read(bytes: Vec<u8>) -> (String, String) {
        let (mut input, hash) = unpacked(io::Cursor::new(bytes), Path::new("log")).unwrap();
        let mut text = String::new();
        input.read_to_string(&mut text).unwrap();
        (text, hash.finish())
    }

    #[test]
    fn packed_bytes_are_unpacked_and_hashed_as_they_are() {
        let text = "t,x\n".to_string() + &"1,2\n".repeat(50_000);
        let mut packer = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
        packer.write_all(text.as_bytes()).unwrap();
        let gzip = packer.finish().unwrap();
        let half = text.len() / 2;
        let packed = |text: &str| {
            ruzstd::encoding::compress_to_vec(text.as_bytes(), ruzstd::encoding::CompressionLevel::Fastest)
        };
        let frames = [packed(&text[..half]), packed(&text[half..])].concat();
        for bytes in [text.clone().into_bytes(), gzip, packed(&text), frames] {
            let expect = hex(&Sha256::digest(&bytes));
            assert_eq!(read(bytes), (text.clone(), expect));
        }
    }
}
