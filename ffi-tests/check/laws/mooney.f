!DIR$ FREEFORM
! Mooney-Rivlin, compressible, in free form as Intel's compiler reads it by the line above.
!
!   W = c10 (I1bar - 3) + c01 (I2bar - 3) + (J - 1)**2 / D1,   I2bar = (I1bar**2 - tr bbar**2) / 2
!   J sigma = dev x + p I,   x = 2 c10 bbar + 2 c01 (I1bar bbar - bbar**2),   p = 2 J (J - 1) / D1
!
! PROPS   1 c10, 2 c01, 3 D1
! STATEV  none
! DDSDDE  Jaumann rate of the Kirchhoff stress, over J: a column is the rate under one unit rate of deformation
! SSE     W, of the volume at rest
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, &
    stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, &
    nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt, &
    layer, kspt, jstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  real(8) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl
  real(8) :: ddsddt(ntens), drplde(ntens), drpldt, stran(ntens), dstran(ntens)
  real(8) :: time(2), dtime, temp, dtemp, predef(1), dpred(1), props(nprops), coords(3)
  real(8) :: drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)

  integer, parameter :: row(6) = [1, 2, 3, 1, 1, 2], column(6) = [1, 2, 3, 2, 3, 3]
  real(8), parameter :: one(3, 3) = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])
  real(8) :: b(3, 3), b2(3, 3), x(3, 3), d(3, 3), h(3, 3), tau(3, 3)
  real(8) :: c10, c01, d1, jacobian, i1, i2
  integer :: k, l

  ddsdde = 0
  jacobian = determinant(dfgrd1)
  if (.not. jacobian > 0) then
    pnewdt = 0.25d0
    return
  end if
  c10 = props(1)
  c01 = props(2)
  d1 = props(3)

  b = jacobian**(-2d0/3)*matmul(dfgrd1, transpose(dfgrd1))
  b2 = matmul(b, b)
  i1 = trace(b)
  i2 = (i1**2 - trace(b2))/2
  x = 2*c10*b + 2*c01*(i1*b - b2)
  tau = deviator(x) + 2/d1*jacobian*(jacobian - 1)*one
  do k = 1, ntens
    stress(k) = tau(row(k), column(k))/jacobian
  end do
  sse = c10*(i1 - 3) + c01*(i2 - 3) + (jacobian - 1)**2/d1

  do l = 1, ntens
    ! A unit of the engineering strain: half of it in either place of a shear.
    d = 0
    d(row(l), column(l)) = 0.5d0
    d(column(l), row(l)) = d(column(l), row(l)) + 0.5d0
    ! bbar's own rate, less the material's turn.
    h = matmul(d, b) + matmul(b, d) - 2d0/3*trace(d)*b
    tau = deviator(2*c10*h + 2*c01*(trace(h)*b + i1*h - matmul(h, b) - matmul(b, h))) &
        + 2/d1*jacobian*(2*jacobian - 1)*trace(d)*one
    do k = 1, ntens
      ddsdde(k, l) = tau(row(k), column(k))/jacobian
    end do
  end do

contains

  pure function trace(a)
    real(8), intent(in) :: a(3, 3)
    real(8) :: trace
    trace = a(1, 1) + a(2, 2) + a(3, 3)
  end function trace

  pure function deviator(a)
    real(8), intent(in) :: a(3, 3)
    real(8) :: deviator(3, 3)
    deviator = a - trace(a)/3*one
  end function deviator

  pure function determinant(a)
    real(8), intent(in) :: a(3, 3)
    real(8) :: determinant
    determinant = a(1, 1)*(a(2, 2)*a(3, 3) - a(2, 3)*a(3, 2)) - a(1, 2)*(a(2, 1)*a(3, 3) - a(2, 3)*a(3, 1)) &
        + a(1, 3)*(a(2, 1)*a(3, 2) - a(2, 2)*a(3, 1))
  end function determinant
end subroutine umat
