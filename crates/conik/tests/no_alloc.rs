//! `step` never touches the heap, whatever the rule finds.

mod paper;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use conik::{ModeRule, Settings};
use paper::Example;

struct Counting;

thread_local! {
    /// Of this thread alone: the test harness has others.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // While a thread ends there is nothing left to count in.
    let _ = ALLOCATIONS.try_with(|n| n.set(n.get() + 1));
}

#[allow(
    unsafe_code,
    reason = "counting needs an allocator of its own; it only passes calls on"
)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count();
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn no_tick_of_any_example_allocates() {
    for number in 1..=3 {
        let border = Settings {
            mode_rule: ModeRule::Border,
            ..Settings::of_the_paper()
        };
        for settings in [Settings::of_the_paper(), border, Settings::at_rate(125.0)] {
            let mut example = Example::new(number, paper::thesis(), settings);
            let before = ALLOCATIONS.get();
            let mut most_active = 0;
            for _ in 0..7500 {
                most_active = most_active.max(example.tick().active.len());
            }
            // Bad input takes its own way out.
            assert!(example.controller.step(&[f64::NAN; 6]).is_err());
            assert!(example.controller.step(&[0.0; 5]).is_err());
            assert_eq!(ALLOCATIONS.get(), before, "example {number}");
            assert!(
                most_active >= 1,
                "the run went through modes with active sets"
            );
        }
    }
    let before = ALLOCATIONS.get();
    drop(std::hint::black_box(Box::new(1)));
    assert!(ALLOCATIONS.get() > before, "the counter counts");
}
