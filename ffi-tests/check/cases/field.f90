! Elastic, its Young's modulus a line of the first field: PROPS are that at 0, and its slope. PROPS(4) is 1 where the law
! forgets DPRED, and 2 where it writes to PREDEF.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
  noel, npt, layer, kspt, jstep, kinc)
  include 'ABA_PARAM.INC'
  character(80) :: cmname
  dimension stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
    dstran(ntens), time(2), predef(*), dpred(*), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), jstep(4)
  field = predef(1)
  if (props(4) < 0.5d0) field = field + dpred(1)
  young = props(1) + props(2)*field
  shear = young/2/(1 + props(3))
  ddsdde = 0
  do i = 1, ndi
    ddsdde(i, 1:ndi) = young*props(3)/(1 + props(3))/(1 - 2*props(3))
    ddsdde(i, i) = ddsdde(i, i) + 2*shear
  end do
  do i = ndi + 1, ntens
    ddsdde(i, i) = shear
  end do
  stress = stress + matmul(ddsdde, dstran)
  if (props(4) > 1.5d0) predef(1) = field + 1
end subroutine umat
