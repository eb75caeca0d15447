//! libtoron as C, Fortran and Python load it: answers, floating-point environments, sanitizers, machine code.

mod abaqus;
mod answers;
mod c_programs;
mod environment;
mod fedoo;
mod felupe;
mod ffi;
mod fortran_module;
mod freestanding;
mod header;
mod installed;
mod instruction_counts;
mod instrumented;
mod machine_code;
mod mgis;
mod newton;
mod openradioss;
mod own_law;
mod package;
mod structures;
mod symbols;
