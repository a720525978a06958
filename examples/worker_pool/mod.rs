//! Work shared out over threads; the answers come back in the order of the work.

use rayon::ThreadPoolBuilder;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The answers to some questions, each worked out on a single thread so that its time means something; after each the number
/// of those that are done is told with it.
pub fn shared_out<Q: Sync, A: Send>(
    questions: &[Q],
    threads: usize,
    one: &(dyn Fn(&Q) -> A + Sync),
    told: &(dyn Fn(usize, &Q, &A) + Sync),
) -> Vec<A> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let slots: Vec<Mutex<Option<A>>> = questions.iter().map(|_| Mutex::new(None)).collect();
    let work = || {
        let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(question) = questions.get(i) else { return };
            let answer = pool.install(|| one(question));
            told(done.fetch_add(1, Ordering::Relaxed) + 1, question, &answer);
            *slots[i].lock().expect("no worker panics while it holds a slot") = Some(answer);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(work);
        }
    });
    let filled = |slot: Mutex<Option<A>>| slot.into_inner().ok().flatten().expect("every question has its turn");
    slots.into_iter().map(filled).collect()
}
