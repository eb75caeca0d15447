! The law as the thesis prints it: invariants of C (Eq. 4.9), second Piola-Kirchhoff stress (Eq. 4.12, 4.14), push-forward.
!
! One point a call, as a user writes it. Eq. 4.14 is 0/0 where the section is undistorted; where its root is not positive
! the distortion carries no stress here, the least that lets it run.
subroutine literal_point(properties, f, stress, state, status) bind(C)
  use, intrinsic :: iso_c_binding
  implicit none
  real(c_double), intent(in) :: properties(11), f(3, 3)
  real(c_double), intent(out) :: stress(6)     ! Cauchy 11 22 33 12 23 31
  real(c_double), intent(inout) :: state(11)   ! W_el W_tc W_td W_ld, I_el I_tc I_td I_ld, index, failed, alive
  integer(c_int), intent(out) :: status
  real(c_double) :: kel, ktc, p, ktd, kld, epslim, alpha, beta, m(3)
  real(c_double) :: c(3, 3), ci(3, 3), cm(3), mm(3, 3), sym(3, 3), s(3, 3), sigma(3, 3)
  real(c_double) :: j, i1, i3, i4, i5, iel, itc, itd, ild, root, index
  integer :: a, b

  kel = properties(1); ktc = properties(2); p = properties(3); ktd = properties(4); kld = properties(5)
  epslim = properties(6); alpha = properties(7); beta = properties(8)
  m = properties(9:11)/norm2(properties(9:11))

  stress = 0
  status = 0
  if (state(10) >= 0.5d0) return
  j = f(1,1)*(f(2,2)*f(3,3) - f(2,3)*f(3,2)) - f(1,2)*(f(2,1)*f(3,3) - f(2,3)*f(3,1)) &
    + f(1,3)*(f(2,1)*f(3,2) - f(2,2)*f(3,1))
  if (.not. j > 0) then
    status = -301
    return
  end if

  c = matmul(transpose(f), f)
  cm = matmul(c, m)
  i1 = c(1,1) + c(2,2) + c(3,3)
  i3 = c(1,1)*(c(2,2)*c(3,3) - c(2,3)**2) - c(1,2)*(c(1,2)*c(3,3) - c(2,3)*c(1,3)) &
     + c(1,3)*(c(1,2)*c(2,3) - c(2,2)*c(1,3))
  i4 = dot_product(m, cm)
  i5 = dot_product(cm, cm)
  iel = 0.5d0*log(i4)
  itc = 0.25d0*log(i3/i4)
  itd = 0.5d0*acosh(max((i1*i4 - i5)/(2*sqrt(i3*i4)), 1d0))
  ild = sqrt(max(i5/i4**2 - 1, 0d0))

  ci(1,1) = (c(2,2)*c(3,3) - c(2,3)**2)/i3
  ci(2,2) = (c(1,1)*c(3,3) - c(1,3)**2)/i3
  ci(3,3) = (c(1,1)*c(2,2) - c(1,2)**2)/i3
  ci(1,2) = (c(1,3)*c(2,3) - c(1,2)*c(3,3))/i3
  ci(2,3) = (c(1,2)*c(1,3) - c(2,3)*c(1,1))/i3
  ci(1,3) = (c(1,2)*c(2,3) - c(1,3)*c(2,2))/i3
  ci(2,1) = ci(1,2); ci(3,2) = ci(2,3); ci(3,1) = ci(1,3)
  do b = 1, 3
    do a = 1, 3
      mm(a, b) = m(a)*m(b)
      sym(a, b) = cm(a)*m(b) + m(a)*cm(b)
    end do
  end do

  s = 0
  if (iel > 0) s = s + kel*iel/i4*mm
  if (itc < 0) s = s - 0.5d0*p*ktc*(-itc)**(p - 1)*(ci - mm/i4)
  root = (i1*i4 - i5)**2 - 4*i3*i4
  if (root > 0) then
    sigma = -(i1*i4 - i5)*ci + (i1 + i5/i4)*mm - 2*sym
    do a = 1, 3
      sigma(a, a) = sigma(a, a) + 2*i4
    end do
    s = s + 2*ktd*itd/(4*sqrt(root))*sigma
  end if
  s = s + kld*(sym/i4**2 - 2*i5/i4**3*mm)
  sigma = matmul(f, matmul(s, transpose(f)))/j
  stress = [sigma(1,1), sigma(2,2), sigma(3,3), sigma(1,2), sigma(2,3), sigma(1,3)]

  state(1) = 0.5d0*kel*max(iel, 0d0)**2
  state(2) = ktc*max(-itc, 0d0)**p
  state(3) = 0.5d0*ktd*itd**2
  state(4) = 0.5d0*kld*ild**2
  state(5:8) = [iel, itc, itd, ild]
  index = 0
  if (iel > 0 .and. epslim > 0) index = iel/log(1 + epslim) + alpha*max(-itc, 0d0) + beta*itd
  state(9) = index
  state(10) = merge(1d0, 0d0, index >= 1)
  state(11) = 1 - state(10)
end subroutine
