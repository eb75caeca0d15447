! Kelvin-Voigt: the stress of the strain and of its rate, which jumps where the rate does. PROPS: E, nu, time of the
! viscosity, factor of the stress where the strain shrinks (1 is right).
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
    dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, &
    dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  implicit none
  character(80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  real(8) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), drplde(ntens)
  real(8) :: drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), dpred(1), props(nprops)
  real(8) :: coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  real(8) :: shear, first, viscous
  integer :: i
  shear = props(1)/(2d0*(1d0 + props(2)))
  first = props(1)*props(2)/((1d0 + props(2))*(1d0 - 2d0*props(2)))
  viscous = 0d0
  if (dtime > 0d0) viscous = props(3)/dtime
  ddsdde = 0d0
  ddsdde(1:3, 1:3) = first
  do i = 1, ntens
    ddsdde(i, i) = ddsdde(i, i) + merge(2d0, 1d0, i <= 3)*shear
  end do
  stress = matmul(ddsdde, stran + (1d0 + viscous)*dstran)
  ddsdde = (1d0 + viscous)*ddsdde
  if (dot_product(stran, dstran) < 0d0) then
    stress = props(4)*stress
    ddsdde = props(4)*ddsdde
  end if
end subroutine
