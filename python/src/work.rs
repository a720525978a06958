//! Long work beside the interpreter: the work runs on threads of its own without the interpreter's lock, progress is told
//! on the caller's thread, and Ctrl-C is asked for there.

use crate::errors::raised;
use creepage::command::stage_text;
use creepage::{OnProgress, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, mpsc};
use std::time::Duration;

/// The time between two looks at Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);

/// Does work on so many threads, all cores for none; `progress` is called with the stage and how many of how many of its
/// parts are done.
pub fn worked<T: Send>(
    py: Python,
    threads: Option<usize>,
    progress: Option<&Bound<PyAny>>,
    job: impl FnOnce(&OnProgress) -> creepage::Result<T> + Send,
) -> PyResult<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    let pool = pool.map_err(|e| PyRuntimeError::new_err(format!("no threads could be started: {e}")))?;
    let (tell, told) = mpsc::channel::<Progress>();
    // Waited for without the interpreter's lock, which takes what threads may share.
    let told = Mutex::new(told);
    let is_stopped = AtomicBool::new(false);
    let is_heard = progress.is_some();
    let (is_stopped, pool) = (&is_stopped, &pool);
    let listen = move |p: Progress| {
        if is_heard {
            let _ = tell.send(p);
        }
        if is_stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let mut failed: Option<PyErr> = None;
    let done = std::thread::scope(|scope| {
        let work = scope.spawn(move || pool.install(|| job(&listen)));
        while !work.is_finished() {
            let heard = py.detach(|| told.lock().ok()?.recv_timeout(LOOK).ok());
            let asked = py.check_signals().and_then(|()| match (heard, progress) {
                (Some(p), Some(call)) if failed.is_none() => {
                    call.call1((stage_text(&p.stage), p.done, p.of)).map(|_| ())
                }
                _ => Ok(()),
            });
            if let Err(error) = asked {
                is_stopped.store(true, Ordering::Relaxed);
                failed.get_or_insert(error);
            }
        }
        work.join()
    });
    match (failed, done) {
        (Some(error), _) => Err(error),
        (None, Ok(done)) => done.map_err(|e| raised(py, &e)),
        (None, Err(_)) => Err(PyRuntimeError::new_err("the work ended in a panic, which is a fault of creepage")),
    }
}
