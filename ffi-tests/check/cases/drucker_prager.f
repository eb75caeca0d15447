C     Plasticity of Drucker and Prager with linear hardening and a
C     potential of its own, a rate law. PROPS: Young's modulus,
C     Poisson's ratio, friction, dilation, cohesion, hardening.
C     STATEV: the plastic multiplier.
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),TIME(2),
     2 PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3)
      DIMENSION DEV(6),FLOW(6),UNIT(6)
      G=PROPS(1)/(2.D0*(1.D0+PROPS(2)))
      BULK=PROPS(1)/(3.D0*(1.D0-2.D0*PROPS(2)))
      FRIC=PROPS(3)
      DILA=PROPS(4)
      HARD=PROPS(6)
      DO I=1,NTENS
        UNIT(I)=0.D0
        IF(I.LE.NDI) UNIT(I)=1.D0
        DO J=1,NTENS
          DDSDDE(I,J)=0.D0
          IF(I.LE.NDI.AND.J.LE.NDI) DDSDDE(I,J)=BULK-2.D0*G/3.D0
        END DO
        DDSDDE(I,I)=DDSDDE(I,I)+G*(1.D0+UNIT(I))
      END DO
      DO I=1,NTENS
        DO J=1,NTENS
          STRESS(I)=STRESS(I)+DDSDDE(I,J)*DSTRAN(J)
        END DO
      END DO
      PRES=(STRESS(1)+STRESS(2)+STRESS(3))/3.D0
      Q=0.D0
      DO I=1,NTENS
        DEV(I)=STRESS(I)-PRES*UNIT(I)
        Q=Q+1.5D0*DEV(I)**2*(2.D0-UNIT(I))
      END DO
      Q=SQRT(Q)
      OVER=Q+FRIC*PRES-PROPS(5)-HARD*STATEV(1)
      IF(OVER.GT.0.D0) THEN
        BELOW=3.D0*G+BULK*FRIC*DILA+HARD
        XL=OVER/BELOW
        DO I=1,NTENS
          FLOW(I)=1.5D0*DEV(I)/Q
          STRESS(I)=STRESS(I)-XL*(2.D0*G*FLOW(I)+BULK*DILA*UNIT(I))
        END DO
        DO I=1,NTENS
          DO J=1,NTENS
            DDSDDE(I,J)=DDSDDE(I,J)
     1       -(2.D0*G*FLOW(I)+BULK*DILA*UNIT(I))
     2       *(2.D0*G*FLOW(J)+BULK*FRIC*UNIT(J))/BELOW
     3       -XL*4.D0*G*G/Q*(-UNIT(I)*UNIT(J)/2.D0-FLOW(I)*FLOW(J))
          END DO
          DDSDDE(I,I)=DDSDDE(I,I)-XL*3.D0*G*G/Q*(1.D0+UNIT(I))
        END DO
        STATEV(1)=STATEV(1)+XL
      END IF
      END
