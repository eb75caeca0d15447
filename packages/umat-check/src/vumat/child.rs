//! The questions to a VUMAT, in the child process.

use std::io;

use super::super::child::Task;
use super::super::finding::{Finding, Question, Verdict};
use super::super::guarded::Guard;
use super::super::material::{Material, Reads};
use super::super::shared_memory::Shared;
use super::call::{Law, Precision, Session};
use super::{blocks, deletion, energy, frame, process, single};
use crate::child::ChildReply;

/// The reply to a task; none where the task is for a UMAT alone.
///
/// # Errors
/// The system has no memory.
pub fn reply_to(
    law: &Law,
    material: &Material,
    task: &Task,
    guard: Guard,
    shared: Shared,
) -> io::Result<Option<ChildReply>> {
    let mut session = Session::new(law, material, Precision::Double, guard, Some(shared));
    Ok(match task {
        Task::Reads => Some(ChildReply::Reads(frame::reads(&mut session)?, true)),
        Task::Question { question, reads, .. } => {
            Some(ChildReply::Finding(answer_question(*question, law, &mut session, *reads)?))
        }
        Task::Other { material: other, after } => {
            if *after {
                blocks::stresses(&mut session)?;
            }
            let mut session = Session::new(law, other, Precision::Double, guard, Some(shared));
            Some(ChildReply::Bits(blocks::stresses(&mut session)?))
        }
        Task::Answers => Some(ChildReply::Bits(blocks::stresses(&mut session)?)),
        Task::OnlyVumat | Task::LargeTurns | Task::Call(_) => None,
    })
}

/// A question to a VUMAT.
fn answer_question(question: Question, law: &Law, session: &mut Session, reads: Reads) -> io::Result<Finding> {
    match question {
        Question::Build | Question::Deck | Question::Memory => process::touch_beyond_arrays(session),
        Question::Rest => process::rest(session),
        Question::Stress => process::stress(session),
        Question::Place => blocks::place(session),
        Question::DataCheck => process::data_check(session),
        Question::Objectivity => frame::objectivity(session),
        Question::Isotropy => frame::isotropy(session),
        Question::Steps => frame::steps(session),
        Question::Energy => energy::energy(session),
        Question::Dissipation => energy::dissipation(session),
        Question::Deletion => deletion::deletion(session),
        Question::Blocks => blocks::blocks(session),
        Question::Single => single::single(session, reads),
        Question::Repeat => blocks::repeat(session),
        Question::Threads => blocks::threads(law, session),
        Question::Outputs => process::outputs(session),
        Question::Exceptions => process::exceptions(session),
        Question::Invalid => process::invalid(session),
        Question::Histories => process::histories(session, reads),
        Question::Runtime => process::runtime(session),
        Question::Coverage => process::coverage(law, session),
        Question::Tangent
        | Question::Cycles
        | Question::Properties
        | Question::Jumps
        | Question::Job
        | Question::Expect
        | Question::Thermal => Ok(Finding::new(question, Verdict::NotAsked, None, "not asked of a VUMAT")),
    }
}
