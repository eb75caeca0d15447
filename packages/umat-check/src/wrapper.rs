//! A UMAT that calls the user's own and returns DDSDDE by differences: what a job runs with until the tangent is
//! mended.

use std::path::Path;

use toron_shared::error::Error;

/// What the user's UMAT is called in the wrapper's file: as long as its name was, so that no line grows.
const RENAMED: &str = "ULAW";

/// The source of the wrapper, with the law's behind it; `free` is whether the law is read in free form.
///
/// # Errors
/// The law cannot be read, or has no `SUBROUTINE UMAT`.
pub fn wrapper(law: &Path, free: bool) -> Result<String, Error> {
    let error = |reason: &str| Error::Input(format!("{}: {reason}", law.display()));
    let bytes = std::fs::read(law).map_err(|reason| error(&reason.to_string()))?;
    let source = String::from_utf8_lossy(&bytes);
    let is_comment = |line: &str| {
        let first = line.chars().next();
        line.trim_start().starts_with('!') || !free && matches!(first, Some('c' | 'C' | '*' | 'd' | 'D'))
    };
    let mut found = false;
    let mut renamed = String::new();
    for line in source.lines() {
        let line = if is_comment(line) { line.to_string() } else { with_other_name(line) };
        let words = line.to_uppercase().replace(' ', "");
        found |= !is_comment(&line) && words.contains(&format!("SUBROUTINE{RENAMED}("));
        renamed += &line;
        renamed.push('\n');
    }
    if !found {
        return Err(error("there is no SUBROUTINE UMAT( in this file; allowed with --wrapper: Fortran that has it"));
    }
    let name = law.file_name().map_or(String::new(), |name| name.to_string_lossy().to_string());
    let body = BODY.replace("@law", &name);
    // In free form a continued line ends in &, in fixed form the next one has it in column 6.
    let (mut text, mut continued) = (String::new(), false);
    if free {
        text += "!DIR$ FREEFORM\n";
    }
    for line in body.lines() {
        let begins = match (free || line.starts_with('!'), continued) {
            (true, _) => "",
            (false, false) => "      ",
            (false, true) => "     & ",
        };
        continued = line.ends_with(" &");
        let line = if free { line } else { line.trim_end_matches(" &") };
        text += &format!("{begins}{line}\n");
    }
    Ok(text + &renamed)
}

/// A line of code with the other name wherever UMAT stands as a word, but for texts and what is behind a `!`.
fn with_other_name(line: &str) -> String {
    let mut quote: Option<char> = None;
    let mut renamed = String::new();
    let mut rest = line;
    while let Some(first) = rest.chars().next() {
        let is_of_word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        let length = match rest.find(|letter: char| !is_of_word(letter)) {
            Some(0) => first.len_utf8(),
            Some(length) => length,
            None => rest.len(),
        };
        let (word, behind) = rest.split_at(length);
        match quote {
            None if first == '!' => return renamed + rest,

            None if first == '\'' || first == '"' => quote = Some(first),
            Some(open) if first == open => quote = None,
            _ => {}
        }
        let is_name = quote.is_none() && word.eq_ignore_ascii_case("umat");
        renamed += if is_name { RENAMED } else { word };
        rest = behind;
    }
    renamed
}

/// Lines of at most 65 columns: those of fixed form have 72. A law of the deformation gets the Jaumann rate of the
/// Kirchhoff stress over J, one of strain increments `∂Δσ/∂Δε + σ⊗I`, and where J is not known, or geometry is linear,
/// `∂Δσ/∂Δε`.
const BODY: &str = "\
! DDSDDE of the UMAT in @law by central differences of its
! stress, written by umat-check. The law stands below, with
! another name. It is called 2 NTENS + 1 times: a law that keeps
! values of its own (SAVE, COMMON) counts these calls too. Where
! a strained call asks for a smaller increment, the column is the
! law's own. Includes and modules are found where they were.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, &
  ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, &
  props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
  noel, npt, layer, kspt, jstep, kinc)
implicit none
integer ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt
integer jstep(4), kinc
character*80 cmname
real*8 stress(ntens), statev(nstatv), ddsdde(ntens, ntens)
real*8 sse, spd, scd, rpl, ddsddt(ntens), drplde(ntens), drpldt
real*8 stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp
real*8 predef(*), dpred(*), props(nprops), coords(3)
real*8 drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
! Of the strained calls.
real*8 h, vol(2), whole, s0(ntens), v0(nstatv), e0(3)
real*8 s(ntens, 2), v(nstatv), d(ntens, ntens), e(3), de(ntens)
real*8 heat(2), by(ntens, 2), pn, least, f(3, 3), g(3, 3), ulawj
integer i, k, m, n, place
logical finite
external ulawj
parameter (h = 1.d-6)
s0 = stress
v0 = statev
e0(1) = sse
e0(2) = spd
e0(3) = scd
call ulaw(stress, statev, ddsdde, sse, spd, scd, rpl, &
  ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, &
  props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
  noel, npt, layer, kspt, jstep, kinc)
if (pnewdt .lt. 1.d0) return
! With NLGEOM, and where J is known.
finite = ndi .eq. 3 .and. jstep(3) .eq. 1
whole = ulawj(dfgrd1)
do i = 1, ntens
  least = 1.d0
  do k = 1, 2
    pn = 2.d0
! The component's tensor; shears are those of engineers.
    place = i
    if (i .gt. ndi) place = i - ndi + 3
    m = place
    n = place
    if (place .gt. 3) m = 1
    if (place .eq. 6) m = 2
    if (place .eq. 4) n = 2
    if (place .gt. 4) n = 3
    g = 0.d0
    g(m, n) = g(m, n) + 0.5d0*h*(3 - 2*k)
    g(n, m) = g(n, m) + 0.5d0*h*(3 - 2*k)
    f = dfgrd1 + matmul(g, dfgrd1)
    de = dstran
    de(i) = de(i) + h*(3 - 2*k)
    s(:, k) = s0
    v = v0
    e = e0
    d = 0.d0
    heat = 0.d0
    by = 0.d0
    call ulaw(s(1, k), v, d, e(1), e(2), e(3), heat(1), &
      by(1, 1), by(1, 2), heat(2), stran, de, time, dtime, &
      temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, &
      nstatv, props, nprops, coords, drot, pn, celent, dfgrd0, f, &
      noel, npt, layer, kspt, jstep, kinc)
    vol(k) = 1.d0
    if (finite) vol(k) = ulawj(f)/whole
    least = min(least, pn)
  end do
  if (least .ge. 1.d0) ddsdde(:, i) = (vol(1)*s(:, 1) &
    - vol(2)*s(:, 2))/(2.d0*h)
end do
end
real*8 function ulawj(f)
implicit none
real*8 f(3, 3)
ulawj = f(1, 1)*(f(2, 2)*f(3, 3) - f(2, 3)*f(3, 2)) &
  - f(1, 2)*(f(2, 1)*f(3, 3) - f(2, 3)*f(3, 1)) &
  + f(1, 3)*(f(2, 1)*f(3, 2) - f(2, 2)*f(3, 1))
end
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_alone_are_changed() {
        let renamed = "call ULAW(X) ! umat";
        assert_eq!(with_other_name("call umat(X) ! umat"), renamed);
        assert_eq!(with_other_name("umat_x = 'umat ''umat'//\"umat\""), "umat_x = 'umat ''umat'//\"umat\"");
        assert_eq!(with_other_name("END SUBROUTINE Umat"), "END SUBROUTINE ULAW");
    }

    /// Lines of fixed form have 72 columns where a compiler is not told otherwise.
    #[test]
    fn lines_are_short() {
        let longest = BODY.lines().map(|line| line.trim_end_matches(" &").len()).max();
        assert!(longest <= Some(65), "{longest:?}");
    }
}
