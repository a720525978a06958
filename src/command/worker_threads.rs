//! The threads that share the work, started one after another while there is room for them.
//!
//! A thread that is short of memory in its first steps, before any of our code runs in it, ends the whole process. It cannot
//! be caught there, so the room is asked for before each thread, and the next one waits until the last has begun.

use std::io;
use std::sync::mpsc;

/// The address space that must be free before a thread is started, in bytes: far more than its stack of 2 MiB, and above the
/// 32 MiB up to which an allocator may answer with memory that it had kept.
const ROOM: usize = 34 << 20;

fn room() -> io::Result<()> {
    let mut room = Vec::<u8>::new();
    let is_there = room.try_reserve_exact(ROOM);
    // An allocation that nobody looks at might be left out.
    std::hint::black_box(&room);
    is_there.map_err(|_| io::ErrorKind::OutOfMemory.into())
}

fn start(worker: rayon::ThreadBuilder) -> io::Result<()> {
    room()?;
    let (begun, has_begun) = mpsc::channel();
    std::thread::Builder::new().spawn(move || {
        // Nobody listens any more where the pool was given up.
        let _ = begun.send(());
        worker.run();
    })?;
    has_begun.recv().map_err(io::Error::other)
}

/// Starts the pool that every parallel loop runs on: `threads` of them, or one for each processor where that is 0.
///
/// # Errors
/// When one of them cannot be started.
pub fn start_pool(threads: usize) -> Result<(), rayon::ThreadPoolBuildError> {
    rayon::ThreadPoolBuilder::new().num_threads(threads).spawn_handler(start).build_global()
}
