//! Spiral Atlas for a worker of a browser: questions and answers as JSON, pictures and files as bytes, through the
//! memory that both sides share. `page/core.js` is the other side.
//!
//! A question is written into [`room`], and [`ask`] answers it. A slice is asked for as any question, and then made by
//! [`refine`], some tiles at a time, so that the worker can look for newer questions in between. No mathematics is
//! here.

mod answer;
mod file;
mod slice;

use file::File;
use serde::Deserialize;
use serde_json::{Value, json};
use slice::Slice;
use spiral_atlas::{Error, Result};
use std::cell::RefCell;

/// What the worker asks.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
enum Question {
    /// The curves between two ends.
    Curves(answer::Curves),
    /// What to do where there is none.
    Advice(answer::Advice),
    /// A path of several pieces.
    Join(answer::Join),
    /// Pieces as a road.
    Road(answer::Road),
    /// A new slice, for [`refine`].
    Slice(slice::Wanted),
    /// A plane through the file that was opened.
    Plane(file::Plane),
}

#[derive(Default)]
struct State {
    input: Vec<u8>,
    output: Vec<u8>,
    slice: Option<Slice>,
    file: Option<File>,
}

thread_local! {
    /// All there is: a worker has one thread.
    static STATE: RefCell<State> = RefCell::default();
}

/// Makes room for so many bytes of input, and says where.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    STATE.with_borrow_mut(|state| {
        state.input.clear();
        state.input.resize(bytes, 0);
        state.input.as_mut_ptr()
    })
}

/// Answers the question in the input, and says where the answer is; [`length`] says how long.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> *const u8 {
    STATE.with_borrow_mut(|state| {
        let answer = state.answer().unwrap_or_else(|e| json!({ "error": e.to_string() }));
        state.put(&answer)
    })
}

/// Opens the input as the bytes of an atlas, and says what it is.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> *const u8 {
    STATE.with_borrow_mut(|state| {
        state.file = None;
        let bytes = std::mem::take(&mut state.input);
        let answer = match File::open(&bytes) {
            Ok(file) => json!(state.file.insert(file).about()),
            Err(e) => json!({ "error": e.to_string() }),
        };
        state.put(&answer)
    })
}

/// The length of the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    STATE.with_borrow(|state| state.output.len())
}

/// Works on so many tiles of the slice, and says how many wait.
#[unsafe(no_mangle)]
pub extern "C" fn refine(tiles: usize) -> usize {
    STATE.with_borrow_mut(|state| state.slice.as_mut().map_or(0, |slice| slice.refine(tiles)))
}

/// Whether every pixel of the slice is known. What is done after that proves what lies between them.
#[unsafe(no_mangle)]
pub extern "C" fn drawn() -> bool {
    STATE.with_borrow(|state| state.slice.as_ref().is_none_or(Slice::drawn))
}

/// Where the verdicts of the slice are: for each pixel its flags, bottom row first.
#[unsafe(no_mangle)]
pub extern "C" fn pixels() -> *const u8 {
    STATE.with_borrow(|state| state.slice.as_ref().map_or(std::ptr::null(), |slice| slice.flags().as_ptr()))
}

/// How many pixels are proved all over, with everything between their points.
#[unsafe(no_mangle)]
pub extern "C" fn proved() -> usize {
    STATE.with_borrow(|state| state.slice.as_ref().map_or(0, Slice::proved))
}

impl State {
    fn answer(&mut self) -> Result<Value> {
        let question: Question = serde_json::from_slice(&self.input)
            .map_err(|e| Error::invalid(format!("the question cannot be read: {e}")))?;
        match question {
            Question::Curves(curves) => curves.answer(),
            Question::Advice(advice) => advice.answer(),
            Question::Join(join) => join.answer(),
            Question::Road(road) => road.answer(),
            Question::Slice(wanted) => {
                self.slice = None;
                Ok(self.slice.insert(Slice::new(wanted)?).about())
            }
            Question::Plane(plane) => {
                let file = self.file.as_ref().ok_or_else(|| Error::invalid("no file is open"))?;
                file.plane(&plane)
            }
        }
    }

    fn put(&mut self, answer: &Value) -> *const u8 {
        self.output = answer.to_string().into_bytes();
        self.output.as_ptr()
    }
}
