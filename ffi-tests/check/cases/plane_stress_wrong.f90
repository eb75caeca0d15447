! For plane stress: linear elastic rate law. The shear of DDSDDE is that of tensor shears, twice too large.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
  noel, npt, layer, kspt, jstep, kinc)
  include 'ABA_PARAM.INC'
  character(80) :: cmname
  dimension stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
    dstran(ntens), time(2), predef(*), dpred(*), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), jstep(4)
  ddsdde = 0
  ddsdde(1, 1) = props(1)/(1 - props(2)**2)
  ddsdde(2, 2) = ddsdde(1, 1)
  ddsdde(1, 2) = props(2)*ddsdde(1, 1)
  ddsdde(2, 1) = ddsdde(1, 2)
  ddsdde(3, 3) = props(1)/2/(1 + props(2))
  stress = stress + matmul(ddsdde, dstran)
  ddsdde(3, 3) = 2*ddsdde(3, 3)
end subroutine umat
