//! What the compiler made of the block's loops: the kernels built for exactly what is asked decide nothing and call
//! nothing between one set of lanes and the next.
//!
//! Reads the disassembly that `objdump` (binutils) gives of the library as it is shipped.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use toron_test_support::library::{LIBRARY, OWN_LAW, run};

/// One instruction: its address, its name and what it is applied to.
struct Instruction {
    address: u64,
    name: String,
    operands: String,
}

impl Instruction {
    /// Where a jump goes; `None` for one through a register or memory.
    fn target(&self) -> Option<u64> {
        u64::from_str_radix(self.operands.split_whitespace().next()?, 16).ok()
    }

    fn jumps(&self) -> bool {
        self.name.starts_with('j')
    }

    fn branches(&self) -> bool {
        self.jumps() && self.name != "jmp"
    }

    fn calls(&self) -> bool {
        self.name.starts_with("call")
    }
}

/// The code of a function, instruction by instruction.
struct Function {
    code: Vec<Instruction>,
    /// The instructions that each may be followed by, as positions in `code`.
    followers: Vec<Vec<usize>>,
}

impl Function {
    fn new(code: Vec<Instruction>) -> Self {
        let at: BTreeMap<u64, usize> = code.iter().enumerate().map(|(k, i)| (i.address, k)).collect();
        let followers = code
            .iter()
            .enumerate()
            .map(|(k, i)| {
                let jump = i.jumps().then(|| i.target().and_then(|target| at.get(&target).copied())).flatten();
                let ends = i.name == "jmp" || i.name.starts_with("ret") || i.name == "ud2";
                let next = (!ends && k + 1 < code.len()).then_some(k + 1);
                jump.into_iter().chain(next).collect()
            })
            .collect();
        Function { code, followers }
    }

    /// The natural loops, one for each jump back: whatever reaches the jump without passing the loop's head.
    fn loops(&self) -> Vec<BTreeSet<usize>> {
        let mut before = vec![Vec::new(); self.code.len()];
        for (k, followers) in self.followers.iter().enumerate() {
            for &follower in followers {
                before[follower].push(k);
            }
        }
        let mut loops = Vec::new();
        for (k, followers) in self.followers.iter().enumerate() {
            for &head in followers.iter().filter(|&&head| self.dominates(head, k)) {
                let mut body = BTreeSet::from([head]);
                let mut open = vec![k];
                while let Some(k) = open.pop() {
                    if body.insert(k) {
                        open.extend(&before[k]);
                    }
                }
                loops.push(body);
            }
        }
        loops
    }

    /// Whether every way from the entry to `k` leads through `head`.
    fn dominates(&self, head: usize, k: usize) -> bool {
        let mut seen = vec![false; self.code.len()];
        let mut open = if head == 0 { vec![] } else { vec![0] };
        while let Some(at) = open.pop() {
            if at != head && !std::mem::replace(&mut seen[at], true) {
                open.extend(&self.followers[at]);
            }
        }
        !seen[k]
    }

    /// Whether an instruction computes with lanes.
    fn computes(&self, k: usize) -> bool {
        let name = &self.code[k].name;
        name.starts_with("vf") || ["vmulp", "vdivp", "vsqrtp"].iter().any(|start| name.starts_with(start))
    }

    /// The kernel's stages: the innermost loops that compute with lanes.
    fn stages(&self) -> Vec<BTreeSet<usize>> {
        let loops = self.loops();
        let innermost = |body: &BTreeSet<usize>| !loops.iter().any(|other| other != body && other.is_subset(body));
        let computes = |body: &BTreeSet<usize>| body.iter().any(|&k| self.computes(k));
        loops.iter().filter(|&body| innermost(body) && computes(body)).cloned().collect()
    }

    /// Whether a stage stores under a mask.
    fn stores_masked(&self) -> bool {
        self.stages().iter().flatten().any(|&k| self.code[k].name.starts_with("vmaskmov"))
    }

    /// How many instructions all stages have together.
    fn size(&self) -> usize {
        self.stages().iter().map(BTreeSet::len).sum()
    }

    /// Calls, and jumps to other functions or to nowhere known.
    fn calls(&self) -> Vec<String> {
        let own: BTreeSet<u64> = self.code.iter().map(|i| i.address).collect();
        let leaves =
            |i: &&Instruction| i.calls() || i.jumps() && i.target().is_none_or(|target| !own.contains(&target));
        self.code.iter().filter(leaves).map(|i| format!("{:x}: {} {}", i.address, i.name, i.operands)).collect()
    }

    /// Where the stack of a large frame is probed in a loop that counts in r11 while that is in use: LLVM does so where
    /// it makes the frame behind a way out of the function.
    fn probes_over_r11(&self) -> Option<u64> {
        let probe = self.code.iter().position(|i| i.name == "mov" && i.operands == "%rsp,%r11")?;
        let loops = self.code.get(probe + 1).is_some_and(|i| i.name == "sub" && i.operands.ends_with(",%r11"));
        let in_use = self.code.iter().take(probe).any(|i| i.operands.contains("%r11"));
        (loops && in_use).then(|| self.code[probe].address)
    }

    /// What the stages hold that they should not: calls, branches beside their own; what is computed in a loop but in
    /// no stage, since a decision makes a loop of it; and jumps to nowhere known, wherever they stand.
    fn faults(&self) -> Vec<String> {
        let unknown = self.code.iter().filter(|i| i.jumps() && i.target().is_none());
        let mut faults: Vec<_> = unknown.map(|i| format!("{:x}: {} {}", i.address, i.name, i.operands)).collect();
        let stages = self.stages();
        for body in &stages {
            let inside: Vec<_> = body.iter().map(|&k| &self.code[k]).collect();
            let calls = inside.iter().filter(|i| i.calls());
            faults.extend(calls.map(|i| format!("{:x}: {} {}", i.address, i.name, i.operands)));
            let branches: Vec<_> = inside.iter().filter(|i| i.branches()).map(|i| format!("{:x}", i.address)).collect();
            if branches.len() != 1 {
                faults.push(format!("branches at {}", branches.join(", ")));
            }
        }
        let looped: BTreeSet<usize> = self.loops().into_iter().flatten().filter(|&k| self.computes(k)).collect();
        let strays = looped.iter().filter(|k| !stages.iter().any(|body| body.contains(k))).count();
        if strays > 0 {
            faults.push(format!("{strays} computations in loops that are no stages"));
        }
        faults
    }
}

/// The functions of a shared library.
fn functions(library: &Path) -> BTreeMap<String, Function> {
    let mut objdump = Command::new("objdump");
    objdump.args(["--disassemble", "--demangle", "--no-show-raw-insn", "--section=.text"]);
    let text = run(objdump.arg(library), "binutils").stdout;

    let mut functions = BTreeMap::new();
    let (mut name, mut code) = (String::new(), Vec::new());
    for line in String::from_utf8_lossy(&text).lines() {
        if let Some((_, title)) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")) {
            functions.insert(std::mem::replace(&mut name, title.into()), Function::new(std::mem::take(&mut code)));
        } else if let Some((address, instruction)) = line.trim_start().split_once(":\t") {
            let Ok(address) = u64::from_str_radix(address, 16) else { continue };
            let (name, operands) = instruction.trim().split_once(' ').unwrap_or((instruction.trim(), ""));
            code.push(Instruction { address, name: name.into(), operands: operands.trim().into() });
        }
    }
    functions.insert(name, Function::new(code));
    functions
}

/// The kernel of a precision, a level and a request, see `law/block/kernel.rs`.
fn kernel<'a>(functions: &'a BTreeMap<String, Function>, precision: &str, level: &str, want: u8) -> &'a Function {
    let set = format!("toron::law::block::{}::{level}", level.to_lowercase());
    let name = format!("<{set} as toron::law::block::instructions::Instructions>::run::<{precision}, {want}>");
    functions.get(&format!("<{name}>")).or_else(|| functions.get(&name)).unwrap_or_else(|| panic!("no function {name}"))
}

/// Stress, and stress with the state: for any fibre directions, and for the first axis.
const USUAL: [u8; 4] = [0, 1, 2, 3];
/// With the state what explicit solvers ask besides, or a longitudinal shear: these look up at run time what points
/// have.
const LOOKING_UP: [u8; 4] = [9, 11, 33, 35];
/// With friction, which decides whether any fibres slide.
const SLIDING: [u8; 4] = [17, 19, 49, 51];
/// The kernel that looks up what the block asks for.
const ANY: u8 = 4;

#[test]
fn usual_kernels_decide_nothing() {
    let functions = functions(&LIBRARY.join("libtoron.so"));
    let mut faults = String::new();
    for precision in ["f64", "f32"] {
        for level in ["Avx2", "Avx512"] {
            for want in USUAL {
                let function = kernel(&functions, precision, level, want);
                let (size, found) = (function.size(), function.faults());
                println!("{precision} {level} {want:>2}: {size} instructions, {found:?}");
                // A loop that is too short is not the law.
                assert!(size > 400, "{precision} {level} {want}: {size} instructions");
                // AMD's processors before Zen 4 execute such a store in microcode.
                assert!(level != "Avx2" || !function.stores_masked(), "{precision} {level} {want}: a masked store");
                if !found.is_empty() {
                    faults += &format!("{precision} {level} {want}: {found:?}\n");
                }
            }
            for want in LOOKING_UP.into_iter().chain(SLIDING) {
                let function = kernel(&functions, precision, level, want);
                let (size, calls) = (function.size(), function.calls());
                println!("{precision} {level} {want:>2}: {size} instructions, calls {calls:?}");
                assert!(size > 400, "{precision} {level} {want}: {size} instructions");
                let masked = level == "Avx2" && function.stores_masked();
                assert!(!masked || SLIDING.contains(&want), "{precision} {level} {want}: a masked store");
                assert!(calls.is_empty(), "{precision} {level} {want}: {calls:?}");
            }
            // The check can fail: a kernel that looks up what it is asked for does not pass it.
            let control = kernel(&functions, precision, level, ANY);
            println!("{precision} {level} any: {:?}", control.faults());
            assert!(!control.faults().is_empty(), "{precision} {level}");
        }
    }
    assert_eq!(faults, "", "branches or calls in the loops");
}

/// The kernels of three laws of one's own, in a library for each precision.
#[test]
fn kernels_of_an_own_law_call_nothing() {
    // What is compiled without AVX-512 has no kernel for it: nothing there would call one.
    let levels: &[&str] = if cfg!(toron_without_avx512) { &["avx2"] } else { &["avx2", "avx512"] };
    for library in ["libown_law_double.so", "libown_law_single.so"] {
        let functions = functions(&OWN_LAW.join(library));
        for level in levels {
            let start = format!("toron::law::user::kernel::{level}::<");
            let kernels: Vec<_> = functions.iter().filter(|(name, _)| name.starts_with(&start)).collect();
            assert_eq!(kernels.len(), 3, "kernels {start}…> in {library}, of three laws");
            for (name, kernel) in kernels {
                let computations = (0..kernel.code.len()).filter(|&k| kernel.computes(k)).count();
                println!("{library} {name}: {computations} computations");
                // A kernel that is too short is not the law.
                assert!(computations > 100, "{library} {name}: {computations} computations");
                let calls = kernel.calls();
                assert!(
                    calls.is_empty(),
                    "{name} of {library} calls other functions, which takes several times as long: {calls:?}. Write the law \
                     with operators and the functions of `vector`, with #[inline(always)] on every function, without closures \
                     and `map`"
                );
            }
        }
    }
}

/// No function loses a register to the probes of its stack.
#[test]
fn probes_of_the_stack_spare_what_is_in_use() {
    let solvers = ["calculix", "mgis", "openradioss", "openradioss_sp", "abaqus", "abaqus_sp"];
    let solvers = solvers.map(|name| LIBRARY.join(format!("libtoron_{name}.so")));
    let own = ["libown_law_double.so", "libown_law_single.so"].map(|name| OWN_LAW.join(name));
    for library in solvers.into_iter().chain(own).chain([LIBRARY.join("libtoron.so")]) {
        for (name, function) in functions(&library) {
            let place = function.probes_over_r11();
            assert!(place.is_none(), "{}: {name} at {:x}", library.display(), place.unwrap_or_default());
        }
    }
}

fn code(lines: &[(&str, &str)]) -> Function {
    let instruction = |(k, &(name, operands)): (usize, &(&str, &str))| Instruction {
        address: k as u64,
        name: name.into(),
        operands: operands.into(),
    };
    Function::new(lines.iter().enumerate().map(instruction).collect())
}

/// The check finds what it looks for in code written for it.
#[test]
fn the_check_can_fail() {
    let clean = [
        ("vmovapd", ""),
        ("vsqrtpd", ""),
        ("add", ""),
        ("vmulpd", ""),
        ("jne", "1 <f+0x1>"),
        ("call", "9"),
        ("ret", ""),
    ];
    assert!(code(&clean).faults().is_empty());
    assert_eq!(code(&clean).calls().len(), 1);
    assert_eq!(code(&[("vmulpd", ""), ("jne", "0 <f>"), ("ret", "")]).calls().len(), 0);
    assert_eq!(code(&[("vmulpd", ""), ("jmp", "20 <memcpy>")]).calls().len(), 1);
    let probed = [("mov", "0x30(%rsi),%r11"), ("je", "9"), ("mov", "%rsp,%r11"), ("sub", "$0x9000,%r11"), ("ret", "")];
    assert_eq!(code(&probed).probes_over_r11(), Some(2));
    assert_eq!(code(&probed[1..]).probes_over_r11(), None);
    // Left at the top, with what follows the loop in its midst.
    let rotated = [
        ("cmp", ""),
        ("jae", "5"),
        ("vsqrtps", ""),
        ("jmp", "7"),
        ("nop", ""),
        ("call", "9"),
        ("ret", ""),
        ("jmp", "0"),
    ];
    assert!(code(&rotated).faults().is_empty());
    // A call, a jump to anywhere, a decision, a turn cut short, a second way out.
    for fault in [("call", "20"), ("call", "*%rax"), ("jmp", "*%rax"), ("je", "4"), ("je", "1"), ("je", "5")] {
        let mut lines = clean;
        lines[2] = fault;
        assert!(!code(&lines).faults().is_empty(), "{fault:?}");
    }
}
