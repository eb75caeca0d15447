! The law without its singularity (docs/theory, the spatial form), as a loop for the vectoriser: from b = F F^T and the
! current fibre direction e, with the singular quotient asinh(s)/s replaced by its series near 0.
subroutine spatial_block(n, ld, properties, f, stress, energies, invariants, failure, status) bind(C)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), value :: n, ld
  real(c_double), intent(in) :: properties(11), f(ld, 9)
  real(c_double), intent(inout) :: stress(ld, 6), energies(ld, 4), invariants(ld, 4), failure(ld, 3)
  integer(c_int), intent(inout) :: status(ld)
  real(c_double) :: kel, ktc, p, ktd, kld, alpha, beta, ilim, limited, m1, m2, m3, m(3)
  real(c_double) :: f11, f21, f31, f12, f22, f32, f13, f23, f33, j, l2, lambda, rl, rj, rt, jt
  real(c_double) :: e1, e2, e3, b11, b22, b33, b12, b23, b31, v1, v2, v3, ebe, half
  real(c_double) :: d11, d22, d33, d12, d23, d31, s2, s, w, a, ratio, iel, itc, itd, ild, tension, compaction, powered
  real(c_double) :: t_el, t_tc, t_td, t_ld, t_ee, index
  logical :: inverted, keeps
  integer :: i

  kel = properties(1); ktc = properties(2); p = properties(3); ktd = properties(4); kld = properties(5)
  limited = merge(1d0, 0d0, properties(6) > 0)
  ilim = log(1 + merge(properties(6), 1d0, properties(6) > 0))
  alpha = properties(7); beta = properties(8)
  m = properties(9:11)/norm2(properties(9:11))
  m1 = m(1); m2 = m(2); m3 = m(3)

  !$omp simd
  do i = 1, n
    f11 = f(i,1); f21 = f(i,2); f31 = f(i,3)
    f12 = f(i,4); f22 = f(i,5); f32 = f(i,6)
    f13 = f(i,7); f23 = f(i,8); f33 = f(i,9)
    j = f11*(f22*f33 - f23*f32) - f12*(f21*f33 - f23*f31) + f13*(f21*f32 - f22*f31)
    e1 = f11*m1 + f12*m2 + f13*m3
    e2 = f21*m1 + f22*m2 + f23*m3
    e3 = f31*m1 + f32*m2 + f33*m3
    l2 = e1*e1 + e2*e2 + e3*e3
    lambda = sqrt(l2)
    rl = 1/lambda
    rj = 1/j
    jt = j*rl
    rt = lambda*rj
    e1 = e1*rl; e2 = e2*rl; e3 = e3*rl

    b11 = f11*f11 + f12*f12 + f13*f13
    b22 = f21*f21 + f22*f22 + f23*f23
    b33 = f31*f31 + f32*f32 + f33*f33
    b12 = f11*f21 + f12*f22 + f13*f23
    b23 = f21*f31 + f22*f32 + f23*f33
    b31 = f31*f11 + f32*f12 + f33*f13
    v1 = b11*e1 + b12*e2 + b31*e3
    v2 = b12*e1 + b22*e2 + b23*e3
    v3 = b31*e1 + b23*e2 + b33*e3
    ebe = v1*e1 + v2*e2 + v3*e3
    ! D = (P b P - half P)/J_t with P b P = b - v e - e v + (e.v) e e and P = 1 - e e.
    half = 0.5d0*(b11 + b22 + b33 - ebe)
    v1 = v1 - ebe*e1; v2 = v2 - ebe*e2; v3 = v3 - ebe*e3   ! now P b e
    t_ee = half - ebe
    d11 = (b11 - half + (t_ee*e1 - 2*v1)*e1)*rt
    d22 = (b22 - half + (t_ee*e2 - 2*v2)*e2)*rt
    d33 = (b33 - half + (t_ee*e3 - 2*v3)*e3)*rt
    d12 = (b12 + t_ee*e1*e2 - v1*e2 - v2*e1)*rt
    d23 = (b23 + t_ee*e2*e3 - v2*e3 - v3*e2)*rt
    d31 = (b31 + t_ee*e3*e1 - v3*e1 - v1*e3)*rt
    s2 = 0.5d0*(d11*d11 + d22*d22 + d33*d33) + d12*d12 + d23*d23 + d31*d31
    s = sqrt(s2)

    w = 1 + s2*(-1d0/6 + s2*(3d0/40 + s2*(-15d0/336 + s2*(105d0/3456 - s2*945d0/42240))))
    a = log(s + sqrt(1 + s2))
    ratio = merge(w, a/max(s, 1d-30), s2 < 1d-3)
    iel = 0.5d0*log(l2)
    itc = 0.5d0*log(jt)
    itd = 0.5d0*s*ratio
    ild = sqrt(max(ebe*rl*rl - 1, 0d0))
    tension = max(iel, 0d0)
    compaction = max(-itc, 0d0)
    powered = ktc*merge(exp((p - 1)*log(max(compaction, 1d-300))), 0d0, compaction > 0)

    inverted = j <= 0
    keeps = inverted .or. failure(i,2) >= 0.5d0
    ! sigma = t_el e e - t_tc P + t_td D + t_ld (P b e e + e P b e)
    t_el = kel*tension*rj
    t_tc = 0.5d0*p*powered*rj
    t_td = 0.25d0*ktd*ratio*rj
    t_ld = kld*rl*rl*rj
    t_ee = t_el + t_tc
    stress(i,1) = merge(0d0, (t_ee*e1 + 2*t_ld*v1)*e1 - t_tc + t_td*d11, keeps)
    stress(i,2) = merge(0d0, (t_ee*e2 + 2*t_ld*v2)*e2 - t_tc + t_td*d22, keeps)
    stress(i,3) = merge(0d0, (t_ee*e3 + 2*t_ld*v3)*e3 - t_tc + t_td*d33, keeps)
    stress(i,4) = merge(0d0, t_ee*e1*e2 + t_ld*(v1*e2 + v2*e1) + t_td*d12, keeps)
    stress(i,5) = merge(0d0, t_ee*e2*e3 + t_ld*(v2*e3 + v3*e2) + t_td*d23, keeps)
    stress(i,6) = merge(0d0, t_ee*e3*e1 + t_ld*(v3*e1 + v1*e3) + t_td*d31, keeps)
    energies(i,1) = merge(energies(i,1), 0.5d0*kel*tension*tension, keeps)
    energies(i,2) = merge(energies(i,2), powered*compaction, keeps)
    energies(i,3) = merge(energies(i,3), 0.5d0*ktd*itd*itd, keeps)
    energies(i,4) = merge(energies(i,4), 0.5d0*kld*ild*ild, keeps)
    invariants(i,1) = merge(invariants(i,1), iel, keeps)
    invariants(i,2) = merge(invariants(i,2), itc, keeps)
    invariants(i,3) = merge(invariants(i,3), itd, keeps)
    invariants(i,4) = merge(invariants(i,4), ild, keeps)
    index = merge(limited*(iel/ilim + alpha*compaction + beta*itd), 0d0, iel > 0)
    failure(i,1) = merge(failure(i,1), index, keeps)
    failure(i,2) = merge(failure(i,2), merge(1d0, 0d0, index >= 1), keeps)
    failure(i,3) = 1 - failure(i,2)
    status(i) = merge(-301, 0, inverted .and. .not. failure(i,2) >= 0.5d0)
  end do
end subroutine
