! Linear elasticity, put together again from the principal strains of SPRIND. PROPS: E, nu.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
    dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, &
    dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  implicit none
  character(80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  real(8) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), drplde(ntens)
  real(8) :: drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), dpred(1), props(nprops)
  real(8) :: coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  real(8) :: shear, first, strain(6), principal(3), axes(3, 3), tensor(3, 3)
  integer :: i
  shear = props(1)/(2d0*(1d0 + props(2)))
  first = props(1)*props(2)/((1d0 + props(2))*(1d0 - 2d0*props(2)))
  strain = stran + dstran
  call sprind(strain, principal, axes, 2, ndi, nshr)
  tensor = 0d0
  do i = 1, 3
    tensor = tensor + (first*sum(principal) + 2d0*shear*principal(i))*matmul(reshape(axes(i, :), [3, 1]), &
      reshape(axes(i, :), [1, 3]))
  end do
  stress = [tensor(1, 1), tensor(2, 2), tensor(3, 3), tensor(1, 2), tensor(1, 3), tensor(2, 3)]
  ddsdde = 0d0
  ddsdde(1:3, 1:3) = first
  do i = 1, 6
    ddsdde(i, i) = ddsdde(i, i) + merge(2d0, 1d0, i <= 3)*shear
  end do
end subroutine
