//! A call as a program in Fortran: what a solver's support or a colleague can compile beside the law, without this
//! check.

use super::call::Call;
use super::material::Material;

/// The program; none where a number is not finite, which Fortran's source cannot have.
pub fn driver(call: &Call, material: &Material, law: &str) -> Option<String> {
    let separated = material.separation.map(|_| call.with_separations(material.unit_of_strain()));
    let call = separated.as_ref().unwrap_or(call);
    let all = call.numbers();
    if all.iter().chain(&material.properties).any(|number| !number.is_finite()) {
        return None;
    }
    let (components, direct) = (material.components, material.direct());
    let counts = format!(
        "  integer, parameter :: ndi = {direct}, nshr = {}, ntens = {components}, nstatv = {}, nprops = {}\n",
        components - direct,
        call.state.len(),
        material.properties.len()
    );
    let [fields, _] = material.passed_fields();
    let arrays = [
        ("stress0", "ntens", &call.stress[..components]),
        ("statev0", "nstatv", &call.state),
        ("stran", "ntens", &call.strain[..components]),
        ("dstran0", "ntens", &call.strain_increment[..components]),
        ("props", "nprops", &material.properties),
        ("time", "2", &call.time),
        ("drot", "9", call.rotation.as_slice()),
        ("dfgrd0", "9", call.f0.as_slice()),
        ("dfgrd10", "9", call.f1.as_slice()),
        ("fields", "8", &fields),
    ];
    let declared: String = arrays.iter().map(|(name, length, values)| array(name, length, values)).collect();
    let [element, point] = call.place;
    let scalars = format!(
        "    dtime = {}; temp = {}; dtemp = {}; noel = {element}; npt = {point}; kinc = {}; jstep = [{}, 1, 1, 0]\n",
        real(call.time_step),
        real(call.temperature),
        real(call.temperature_step),
        call.increment,
        call.step
    );
    let name = material.name.to_uppercase().replace('\'', "''");
    Some(
        format!(
            "! One call of the UMAT in {law}, and DDSDDE beside differences of its stress. Where the law includes\n\
         ! ABA_PARAM.INC, first\n\
         ! echo '      implicit real*8(a-h,o-z)' > ABA_PARAM.INC\n\
         ! gfortran -std=legacy -ffixed-line-length-132 -I. {law} THIS.f90 THIS.c -lpthread -o one && ./one\n\
         ! THIS.c, beside it, has ROTSIG, XIT and other routines that Abaqus has.\n\
         program one\n  implicit none\n{counts}{declared}{BODY}",
        )
        .replace("h = 1d-6", &format!("h = {}", real(STEP * material.unit_of_strain())))
        .replace("@scalars\n", &scalars)
        .replace("@name", &name),
    )
}

/// Of strain, for differences.
const STEP: f64 = 1e-6;

fn real(number: f64) -> String {
    format!("{number:e}").replace('e', "d")
}

fn array(name: &str, length: &str, values: &[f64]) -> String {
    if values.is_empty() {
        return format!("  real(8) :: {name}({length})\n");
    }
    let values: Vec<String> = values.iter().map(|value| real(*value)).collect();
    let lines: Vec<String> = values.chunks(4).map(|chunk| chunk.join(", ")).collect();
    format!("  real(8) :: {name}({length}) = [ &\n    {}]\n", lines.join(", &\n    "))
}

/// The differences are of the Cauchy stress and of the Kirchhoff stress over J.
const BODY: &str = "\
  real(8), parameter :: h = 1d-6
  real(8) :: stress(ntens), plus(ntens), minus(ntens), ddsdde(ntens, ntens), other(ntens, ntens), j1, j2, j0
  integer :: i
  call answer(0, 0d0, stress, ddsdde, j0)
  print '(a, 6es16.7)', 'stress', stress
  print '(a)', 'column, DDSDDE, differences of the Cauchy stress, of the Kirchhoff stress over J'
  do i = 1, ntens
    call answer(i, h, plus, other, j1)
    call answer(i, -h, minus, other, j2)
    print '(i1, a, 6es16.7)', i, ' DDSDDE   ', ddsdde(:, i)
    print '(i1, a, 6es16.7)', i, ' Cauchy   ', (plus - minus)/(2*h)
    print '(i1, a, 6es16.7)', i, ' Kirchhoff', (j1*plus - j2*minus)/(2*h*j0)
  end do
contains
  subroutine answer(column, size, stress, ddsdde, jacobian)
    integer, intent(in) :: column
    real(8), intent(in) :: size
    real(8), intent(out) :: stress(ntens), ddsdde(ntens, ntens), jacobian
    integer, parameter :: row(6) = [1, 2, 3, 1, 1, 2], col(6) = [1, 2, 3, 2, 3, 3]
    real(8) :: statev(nstatv), dstran(ntens), f(3, 3), e(3, 3), sse, spd, scd, rpl, ddsddt(6), drplde(6), drpldt, dtime
    real(8) :: temp, dtemp, predef(8), dpred(8), coords(3), pnewdt, celent
    integer :: noel, npt, layer, kspt, kinc, jstep(4), place
    character(80) :: cmname
@scalars
    sse = 0; spd = 0; scd = 0; rpl = 0; ddsddt = 0; drplde = 0; drpldt = 0; predef = fields; dpred = 0; coords = 0
    pnewdt = 1; celent = 1; layer = 1; kspt = 1; cmname = '@name'
    stress = stress0; statev = statev0; dstran = dstran0; ddsdde = 0
    f = reshape(dfgrd10, [3, 3]); e = 0
    if (column > 0) then
      dstran(column) = dstran(column) + size
      place = merge(column + 3 - ndi, column, column > ndi)
      e(row(place), col(place)) = e(row(place), col(place)) + size/2
      e(col(place), row(place)) = e(col(place), row(place)) + size/2
      f = f + matmul(e, f)
    end if
    jacobian = f(1,1)*(f(2,2)*f(3,3) - f(2,3)*f(3,2)) - f(1,2)*(f(2,1)*f(3,3) - f(2,3)*f(3,1)) &
      + f(1,3)*(f(2,1)*f(3,2) - f(2,2)*f(3,1))
    call umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, dtemp, &
      predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, f, noel, npt, &
      layer, kspt, jstep, kinc)
  end subroutine answer
end program one
";
